// Processor time of other programs is told apart from our own.
#include "src/app/machine_load.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace barchan {
namespace {

TEST(MachineLoad, AllButIdleAndWaitingCounts) {
  EXPECT_DOUBLE_EQ(*seconds_of_all("cpu  100 20 30 4000 500 6 7 8 0 0\ncpu0 1 2 3\n", 100), 1.71);
  EXPECT_FALSE(seconds_of_all("", 100));
  EXPECT_FALSE(seconds_of_all("cpu0 1 2 3 4 5 6 7 8\n", 100));
  EXPECT_FALSE(seconds_of_all("cpu 1 2 3\n", 100));
}

TEST(MachineLoad, OthersAreAllButOurselves) {
  const ProcessorSeconds before{100, 10, 50}, after{105, 12, 52};
  EXPECT_DOUBLE_EQ(cores_of_others(before, after), 1.5);
  // The counts of the system are in hundredths of a second: never less than nothing.
  EXPECT_DOUBLE_EQ(cores_of_others({1, 1, 1}, {1.99, 2, 2}), 0.0);
  EXPECT_DOUBLE_EQ(cores_of_others(before, before), 0.0);
}

TEST(MachineLoad, OurOwnWorkIsNotThatOfOthers) {
  const auto before = processor_seconds();
  if (!before) GTEST_SKIP() << "no /proc/stat";
  volatile double sum = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
  while (std::chrono::steady_clock::now() < end) sum = sum + 1;
  const auto after = processor_seconds();
  ASSERT_TRUE(after);
  EXPECT_GT(after->own - before->own, 0.02);  // however busy the machine is
  EXPECT_GE(after->of_all - before->of_all + 0.02, after->own - before->own);
}

}  // namespace
}  // namespace barchan
