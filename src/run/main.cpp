// barchan run | check | keys | info: from the command line to an exit code.
#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <thread>

#include "barchan_version.hpp"
#include "src/base/errors.hpp"
#include "src/base/report.hpp"
#include "src/base/words.hpp"
#include "src/config/resolved.hpp"
#include "src/parallel/communicator.hpp"
#include "src/run/check.hpp"
#include "src/run/command_line.hpp"
#include "src/run/info.hpp"
#include "src/run/run_case.hpp"

namespace {

/// MPI for the life of main. Threads are there (OpenMP's, the watchdog's) but leave MPI to the main
/// thread; calls from several at once would cost locks.
struct MpiScope {
  MpiScope(int* argc, char*** argv) {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(argc, argv, MPI_THREAD_SERIALIZED, &provided);
    MPI_Comm_dup(MPI_COMM_WORLD, &refusals);
  }
  ~MpiScope() {
    MPI_Comm_free(&refusals);
    MPI_Finalize();
  }
  MpiScope(const MpiScope&) = delete;
  MpiScope& operator=(const MpiScope&) = delete;

  MPI_Comm refusals = MPI_COMM_NULL;  // ranks may meet here while others are busy in the world
};

/// Kokkos ends the program with a stack trace when it cannot read its own settings.
void check_environment() {
  for (const char* name : {"KOKKOS_NUM_THREADS", "KOKKOS_DEVICE_ID"}) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): there are no other threads yet
    const char* const set = std::getenv(name);
    if (set == nullptr) continue;
    const std::string_view text = set;
    int value = -1;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const int least = std::string_view(name) == "KOKKOS_NUM_THREADS" ? 1 : 0;
    if (error == std::errc() && stop == text.data() + text.size() && value >= least) continue;
    throw barchan::InputError(std::string("the environment variable ") + name + " = \"" + set +
                              "\" must be a whole number of at least " + std::to_string(least) +
                              "; unset it, or use --threads");
  }
}

int execute(const barchan::CommandLine& line) {
  using barchan::Command;
  switch (line.command) {
    case Command::run: {
      check_environment();
      Kokkos::InitializationSettings settings;
      if (line.threads > 0) settings.set_num_threads(line.threads);
      // Ranks that share cores were asked for: a warning from each would bury the run's own lines.
      if (barchan::rank_count(MPI_COMM_WORLD) > 1) settings.set_disable_warnings(true);
      const Kokkos::ScopeGuard kokkos(settings);
      return barchan::run_command(line);
    }
    case Command::check:
      return barchan::run_check(line, std::cout);
    case Command::keys:
      std::cout << barchan::keys_page();
      return 0;
    case Command::info:
      return barchan::run_info(line.file);
    case Command::none:
      break;
  }
  if (barchan::rank_of(MPI_COMM_WORLD) == 0) {
    (line.exit_code == 0 ? std::cout : std::cerr) << line.text;
  }
  return line.exit_code;
}

/// One message and an end for all ranks. A problem that all of them met is told by rank 0, which
/// ends the others; one that another rank met alone is told by that rank a moment later.
int fail(const std::string& words, int exit_code) {
  const std::string message = barchan::printable_lines(words);
  const int rank = barchan::rank_of(MPI_COMM_WORLD);
  if (rank == 0) {
    barchan::report::error("{}", message);
  } else {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    std::cerr << "error: rank " + std::to_string(rank) + ": " + message + "\n" << std::flush;
  }
  if (barchan::rank_count(MPI_COMM_WORLD) > 1) MPI_Abort(MPI_COMM_WORLD, exit_code);
  return exit_code;
}

/// Bad input is a quiet end where all ranks read the same; a file may also be missing on one node.
int refuse(const MpiScope& mpi, const std::string& message) {
  constexpr int bad_input = 2;
  if (!barchan::all_come(mpi.refusals, std::chrono::seconds(2))) return fail(message, bad_input);
  if (barchan::rank_of(MPI_COMM_WORLD) == 0) std::cerr << barchan::printable_lines(message) << '\n';
  return bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told like a full disk
  const MpiScope mpi(&argc, &argv);
  try {
    const auto line = barchan::parse_command_line(
        argc, argv, "barchan " BARCHAN_VERSION " (" BARCHAN_GIT_HASH ")");
    barchan::report::start(line.quiet, barchan::rank_of(MPI_COMM_WORLD));
    return execute(line);
  } catch (const barchan::InputError& problem) {
    return refuse(mpi, problem.what());
  } catch (const std::exception& problem) {
    return fail(problem.what(), 1);
  }
}
