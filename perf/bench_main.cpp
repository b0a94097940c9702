// Entry of the performance suite: MPI and Kokkos live for the whole run, and every result says
// where it was measured.
#include <benchmark/benchmark.h>
#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <string>

#include "barchan_version.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  {
    Kokkos::ScopeGuard kokkos(argc, argv);
    benchmark::AddCustomContext("version", BARCHAN_VERSION);
    benchmark::AddCustomContext("git_hash", BARCHAN_GIT_HASH);
    benchmark::AddCustomContext("backend", Kokkos::DefaultExecutionSpace::name());
    benchmark::AddCustomContext("kokkos_threads",
                                std::to_string(Kokkos::DefaultHostExecutionSpace().concurrency()));
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
      status = 2;
    } else {
      benchmark::RunSpecifiedBenchmarks();
    }
    benchmark::Shutdown();
  }
  MPI_Finalize();
  return status;
}
