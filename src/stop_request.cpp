#include "src/stop_request.hpp"

#include <csignal>

namespace barchan {

namespace {

volatile std::sig_atomic_t received = 0;

void note(int signal) {
  received = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_stop_signals() {
  received = 0;
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

int stop_signal() { return received; }

}  // namespace barchan
