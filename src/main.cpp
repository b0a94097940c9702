// barchan run | check | info: from the command line to an exit code.
#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <exception>
#include <iostream>

#include "barchan_version.hpp"
#include "src/check.hpp"
#include "src/command_line.hpp"
#include "src/config_load.hpp"
#include "src/info.hpp"
#include "src/report.hpp"
#include "src/run_case.hpp"

namespace {

/// MPI for the life of main.
struct MpiScope {
  MpiScope(int* argc, char*** argv) { MPI_Init(argc, argv); }
  ~MpiScope() { MPI_Finalize(); }
  MpiScope(const MpiScope&) = delete;
  MpiScope& operator=(const MpiScope&) = delete;
};

int execute(const barchan::CommandLine& line) {
  using barchan::Command;
  switch (line.command) {
    case Command::run: {
      Kokkos::InitializationSettings settings;
      if (line.threads > 0) settings.set_num_threads(line.threads);
      const Kokkos::ScopeGuard kokkos(settings);
      return barchan::run_command(line);
    }
    case Command::check: return barchan::run_check(line, std::cout);
    case Command::info: return barchan::run_info(line.file);
    case Command::none: break;
  }
  (line.exit_code == 0 ? std::cout : std::cerr) << line.text;
  return line.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  const MpiScope mpi(&argc, &argv);
  try {
    const auto line = barchan::parse_command_line(
        argc, argv, "barchan " BARCHAN_VERSION " (" BARCHAN_GIT_HASH ")");
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (ranks > 1) {
      if (rank == 0) std::cerr << "this version runs on one rank; start it without mpirun, or with --ranks 1\n";
      return 2;
    }
    barchan::report::start(line.quiet);
    return execute(line);
  } catch (const barchan::ConfigError& problem) {
    std::cerr << problem.what() << '\n';
    return 2;
  } catch (const std::exception& problem) {
    barchan::report::error("{}", problem.what());
    return 1;
  }
}
