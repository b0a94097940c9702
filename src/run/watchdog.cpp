#include "src/run/watchdog.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <stop_token>

#include "src/base/stop_request.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto look_interval = std::chrono::milliseconds(250);
// More than this between two looks [s]: the process was stopped (Ctrl-Z, a suspended job), and the
// rest of it is no waiting.
constexpr double longest_look = 1;
// Rank k speaks k times this later [s]: the lowest waiting rank ends the others before they speak.
constexpr double turn = 2;
// The others hear of that by SIGTERM, and have this long until they are killed [s].
constexpr double farewell = 60;
constexpr auto time_to_abort = std::chrono::seconds(5);

/// Written by the main thread alone. The others read it when it no longer changes.
struct Pulse {
  std::atomic<std::uint64_t> beats{0};
  std::atomic<const char*> doing{"starting"};
  std::atomic<std::int64_t> step{0};
  std::atomic<double> time{0};
  std::mutex mutex;     // of the next
  std::string restart;  // the last good one
};
Pulse pulse;

/// MPI is not promised calls from two threads at once (that would cost every message), so this one
/// may get stuck like the main thread. mpirun also ends all ranks when one leaves by itself.
[[noreturn]] void end_all(MPI_Comm communicator) {
  std::thread([] {
    std::this_thread::sleep_for(time_to_abort);
    std::_Exit(1);
  }).detach();
  MPI_Abort(communicator, 1);
  std::_Exit(1);
}

void say(LongWait wait) {
  wait.doing = pulse.doing;
  wait.step = pulse.step;
  wait.time = pulse.time;
  {
    const std::lock_guard lock(pulse.mutex);
    wait.restart = pulse.restart;
  }
  // At once and whole; the locks of the streams may be what the main thread is stuck in.
  const std::string line = to_text(wait);
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
}

/// Counts the seconds without a beat, of those in which this process ran.
void watch(const std::stop_token& stop, LongWait wait, int patience, MPI_Comm communicator) {
  const double limit = patience + wait.rank * turn;
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any stopped;
  auto last_beats = pulse.beats.load(std::memory_order_acquire);
  auto last_look = Clock::now();
  while (wait.seconds < (stop_signal() == 0 ? limit : limit + farewell)) {
    stopped.wait_for(lock, stop, look_interval, [] { return false; });
    if (stop.stop_requested()) return;
    const auto beats = pulse.beats.load(std::memory_order_acquire);
    const auto now = Clock::now();
    const double passed = std::chrono::duration<double>(now - last_look).count();
    wait.seconds = beats == last_beats ? wait.seconds + std::min(passed, longest_look) : 0;
    last_beats = beats;
    last_look = now;
  }
  say(wait);
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
  LongWait wait;
  wait.rank = rank_of(communicator);
  wait.host.assign(host.data(), static_cast<std::size_t>(length));
  thread_ = std::jthread([wait, patience, communicator](const std::stop_token& stop) {
    watch(stop, wait, patience, communicator);
  });
}

void Watchdog::beat(const char* doing, std::int64_t step, double time) {
  pulse.doing.store(doing, std::memory_order_relaxed);
  pulse.step.store(step, std::memory_order_relaxed);
  pulse.time.store(time, std::memory_order_relaxed);
  const auto beats = pulse.beats.load(std::memory_order_relaxed);  // one writer: no locked add
  pulse.beats.store(beats + 1, std::memory_order_release);
}

void Watchdog::last_good_restart(const std::filesystem::path& file) {
  const std::lock_guard lock(pulse.mutex);
  pulse.restart = file.string();
}

}  // namespace barchan
