#include "src/io/hdf5_guard.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>

namespace barchan::hdf5 {

namespace {

constexpr std::array<int, 5> faults{SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGALRM};
std::array<struct sigaction, faults.size()> handlers_before;
// Whole before the handlers are there; a handler may only hand it on.
std::string line;

/// Nothing but what a signal handler may call.
void end_with_the_line(int) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
  std::_Exit(2);
}

}  // namespace

Guard::Guard(const std::filesystem::path& file) {
  line = "cannot read " + file.string() +
         ": it is damaged (the HDF5 library fails on a text in it); take another copy\n";
  struct sigaction action {};
  action.sa_handler = end_with_the_line;
  sigemptyset(&action.sa_mask);
  for (std::size_t n = 0; n < faults.size(); ++n) {
    ::sigaction(faults[n], &action, &handlers_before[n]);
  }
  ::alarm(kPatience);
}

Guard::~Guard() {
  ::alarm(0);
  for (std::size_t n = 0; n < faults.size(); ++n) {
    ::sigaction(faults[n], &handlers_before[n], nullptr);
  }
}

}  // namespace barchan::hdf5
