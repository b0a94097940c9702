#include "src/run/watchdog.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "src/base/stopwatch.hpp"

namespace barchan {
namespace {

TEST(Watchdog, BeatsKeepItQuietBeyondItsPatience) {
  const Watchdog watchdog(1, MPI_COMM_WORLD);  // would end the program and fail the test
  for (int n = 0; n < 15; ++n) {
    Watchdog::heartbeat("testing", n, 0.1 * n);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

TEST(Watchdog, GoesAtOnceWithItsRun) {
  const auto start = WallClock::now();
  for (int n = 0; n < 20; ++n) const Watchdog watchdog(600, MPI_COMM_WORLD);
  EXPECT_LT(seconds_since(start), 2.0);  // 20 looks would be 5 s
}

}  // namespace
}  // namespace barchan
