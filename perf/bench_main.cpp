// Entry of the performance suite: MPI and Kokkos live for the whole run.
#include <fmt/core.h>
#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <exception>
#include <string_view>

#include "perf/bench.hpp"
#include "perf/cases.hpp"
#include "perf/events.hpp"
#include "perf/options.hpp"
#include "src/parallel/start_mpi.hpp"

namespace barchan {
namespace {

/// Takes our own options out of the command line.
void take_options(int& argc, char** argv) {
  int kept = 1;
  for (int n = 1; n < argc; ++n) {
    const std::string_view argument = argv[n];
    const std::size_t equal = argument.find('=');
    const std::string_view name = argument.substr(0, equal);
    const std::string_view value = equal < argument.size() ? argument.substr(equal + 1) : "";
    if (argument == "--tiny") {
      options().tiny = true;
    } else if (name == "--heaps") {
      options().heaps = value;
    } else if (name == "--runs") {
      options().runs = value;
    } else if (name == "--records") {
      options().records = value;
    } else {
      argv[kept++] = argv[n];
    }
  }
  argc = kept;
}

int run_suite(int argc, char** argv) {
  take_options(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  register_bandwidth();
  register_cases();
  register_kernels();
  RecordReporter reporter;
  const std::size_t n_run = benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return n_run == 0 || reporter.failed() ? 1 : 0;
}

int run_suite_or_say_why(int argc, char** argv) {
  try {
    return run_suite(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "barchan_bench: {}\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace barchan

int main(int argc, char** argv) {
  barchan::start_mpi(&argc, &argv);
  int status = 0;
  {
    const Kokkos::ScopeGuard kokkos(argc, argv);
    barchan::watch_arrays();
    status = barchan::run_suite_or_say_why(argc, argv);
    barchan::drop_running_case();
  }
  MPI_Finalize();
  return status;
}
