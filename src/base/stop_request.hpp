// Polite end of a run: SIGINT, SIGTERM, SIGHUP or the wall-clock limit.
#pragma once

#include <atomic>
#include <csignal>
#include <ctime>

namespace barchan {

/// Number of the signal that came, 0 if none did. The watchdog's thread looks at it too, and a
/// signal may come to any thread: volatile is not enough.
inline std::atomic<int> stop_signal = 0;
inline std::atomic<std::time_t> stop_signal_came = 0;  // [s], of a clock that only goes forward
static_assert(std::atomic<int>::is_always_lock_free &&
                  std::atomic<std::time_t>::is_always_lock_free,
              "a signal handler may not wait for a lock");

/// Notes a signal. Launchers and batch systems may send several signals at once; one that comes
/// more than a second later is a person who means it, and ends the program.
inline void note_stop_signal(int signal) {
  std::timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);  // as std::signal and std::raise, allowed in a handler
  if (stop_signal == 0) {
    stop_signal_came = now.tv_sec;
    stop_signal = signal;
  } else if (now.tv_sec > stop_signal_came + 1) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

/// Makes SIGINT, SIGTERM and SIGHUP only leave a note, which stays: a case that is run before the
/// one that was asked for must not use it up. A SIGHUP that is ignored (nohup) stays so.
inline void catch_stop_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto before = std::signal(signal, note_stop_signal);
    if (signal == SIGHUP && before == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

}  // namespace barchan
