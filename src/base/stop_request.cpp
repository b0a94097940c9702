#include "src/base/stop_request.hpp"

#include <atomic>
#include <csignal>

namespace barchan {

namespace {

// The watchdog's thread looks at it too, and a signal may come to any thread: volatile is not
// enough.
std::atomic<int> received{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not wait for a lock");

void note(int signal) {
  received.store(signal, std::memory_order_relaxed);
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_stop_signals() {
  received.store(0, std::memory_order_relaxed);
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

int stop_signal() { return received.load(std::memory_order_relaxed); }

}  // namespace barchan
