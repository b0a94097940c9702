#include "src/run/watchdog.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <stop_token>

#include "src/base/stop_request.hpp"
#include "src/base/stopwatch.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

constexpr auto kLookInterval = std::chrono::milliseconds(250);
// Longest time between two looks [s]: after a longer one the process was stopped (Ctrl-Z, a
// suspended job), and the rest of it counts as no waiting.
constexpr double kLongestLook = 1;
// Delay of rank k's message, over k [s]: the lowest waiting rank ends the others before they speak.
constexpr double kRankDelay = 2;
// Time that the other ranks have after SIGTERM until they are killed [s].
constexpr double kGracePeriod = 60;
constexpr auto kTimeToAbort = std::chrono::seconds(5);

std::mutex mutex;  // guards `now`
LongWait now;      // wait of this rank: a heartbeat sets its seconds back, the watchdog counts them

/// Ends all ranks. MPI is not promised calls from two threads at once (that would cost every
/// message), so this one may get stuck like the main thread. mpirun also ends all ranks when one
/// leaves by itself.
[[noreturn]] void end_all(MPI_Comm communicator) {
  std::thread([] {
    std::this_thread::sleep_for(kTimeToAbort);
    std::_Exit(1);
  }).detach();
  MPI_Abort(communicator, 1);
  std::_Exit(1);
}

/// Counts the seconds without a heartbeat during which this process ran.
void watch(const std::stop_token& stop, int patience, MPI_Comm communicator) {
  std::unique_lock lock(mutex);
  std::condition_variable_any stopped;
  const double limit = patience + now.rank * kRankDelay;
  auto last_look = WallClock::now();
  while (now.seconds < (stop_signal == 0 ? limit : limit + kGracePeriod)) {
    stopped.wait_for(lock, stop, kLookInterval, [] { return false; });
    if (stop.stop_requested()) return;
    now.seconds += std::min(seconds_since(last_look), kLongestLook);
    last_look = WallClock::now();
  }
  // Write at once and whole: the main thread may be stuck in the locks of the streams.
  const std::string line = to_text(now);
  lock.unlock();
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
  end_all(communicator);
}

}  // namespace

std::string to_text(const LongWait& wait) {
  const std::string when =
      wait.step > 0 ? fmt::format(" (fluid step {}, t = {:.6g} s)", wait.step, wait.time) : "";
  const std::string go_on =
      wait.restart.empty() ? "" : "; go on with the last good restart, " + wait.restart;
  return fmt::format(
      "error: rank {} on {} has waited {:.0f} s while {}{}: another rank, the network or a disk "
      "hangs, or --patience is too short{}\n",
      wait.rank, wait.host, wait.seconds, wait.doing, when, go_on);
}

Watchdog::Watchdog(int patience, MPI_Comm communicator) {
  if (patience <= 0 || rank_count(communicator) == 1) return;
  std::array<char, MPI_MAX_PROCESSOR_NAME> host{};
  int length = 0;
  MPI_Get_processor_name(host.data(), &length);
  now.rank = rank_of(communicator);
  now.host.assign(host.data(), static_cast<std::size_t>(length));
  now.seconds = 0;
  thread_ = std::jthread([patience, communicator](const std::stop_token& stop) {
    watch(stop, patience, communicator);
  });
}

void Watchdog::heartbeat(const char* doing, std::int64_t step, double time) {
  const std::lock_guard lock(mutex);
  now.doing = doing;
  now.step = step;
  now.time = time;
  now.seconds = 0;
}

void Watchdog::last_good_restart(const std::filesystem::path& file) {
  const std::lock_guard lock(mutex);
  now.restart = file.string();
}

}  // namespace barchan
