// A polite end: SIGINT, SIGTERM or the wall-clock limit.
#pragma once

#include <atomic>
#include <csignal>

namespace barchan {

/// Number of the signal that came, 0 if none did. The watchdog's thread looks at it too, and a
/// signal may come to any thread: volatile is not enough.
inline std::atomic<int> stop_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not wait for a lock");

/// From now on SIGINT and SIGTERM only leave a note; a second one ends the program at once.
inline void catch_stop_signals() {
  stop_signal = 0;
  for (const int signal : {SIGINT, SIGTERM}) {
    std::signal(signal, [](int came) {
      stop_signal = came;
      std::signal(came, SIG_DFL);
    });
  }
}

}  // namespace barchan
