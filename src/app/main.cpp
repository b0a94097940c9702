// barchan run | check | new | keys | info: from the command line to an exit code.
#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>

#include <Kokkos_Core.hpp>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <thread>
#include <tuple>

#include "barchan_version.hpp"
#include "src/app/check_case.hpp"
#include "src/app/info_path.hpp"
#include "src/app/run_case.hpp"
#include "src/base/errors.hpp"
#include "src/base/report.hpp"
#include "src/base/words.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/start_mpi.hpp"
#include "src/toml/keys_page.hpp"
#include "src/toml/schema.hpp"

namespace barchan {
namespace {

/// MPI for the life of main. Threads are there (OpenMP's, the watchdog's) but leave MPI to the main
/// thread; calls from several at once would cost locks.
struct MpiScope {
  MpiScope(int* argc, char*** argv) {
    start_mpi(argc, argv);
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

/// Refuses settings that Kokkos cannot read: it would end the program with a stack trace.
void check_environment() {
  constexpr int kMost = std::numeric_limits<int>::max();
  for (const auto& [name, least, most] :
       {std::tuple{"KOKKOS_NUM_THREADS", 1, kMostThreads}, {"KOKKOS_DEVICE_ID", 0, kMost}}) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): there are no other threads yet
    const char* const set = std::getenv(name);
    if (set == nullptr) continue;
    const char* const end = set + std::strlen(set);
    int value = -1;
    const auto [stop, error] = std::from_chars(set, end, value);
    if (error == std::errc() && stop == end && value >= least && value <= most) continue;
    throw InputError(
        fmt::format("the environment variable {} = \"{}\" must be a whole number of at least {}{}; "
                    "unset it, or use --threads",
                    name, set, least, most < kMost ? fmt::format(" and at most {}", most) : ""));
  }
}

/// Number of threads that --threads asks for, or as many as Kokkos can have; 0: Kokkos chooses.
int threads_of(const CommandLine& line) {
  if (line.threads > 0) return line.threads;
  // NOLINTBEGIN(concurrency-mt-unsafe): there are no other threads yet
  if (std::getenv("KOKKOS_NUM_THREADS") != nullptr) return 0;
  const char* const set = std::getenv("OMP_NUM_THREADS");
  // NOLINTEND(concurrency-mt-unsafe)
  const unsigned long by_itself =
      set != nullptr ? std::strtoul(set, nullptr, 10) : std::thread::hardware_concurrency();
  return by_itself > kMostThreads ? kMostThreads : 0;
}

/// Opens closed standard streams to nowhere. Else the next file that is opened would take the
/// number of one, and messages would go into the results.
void keep_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0)
      ::open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY);
  }
}

template <class Work>
int with_kokkos(const CommandLine& line, const Work& work) {
  check_environment();
  Kokkos::InitializationSettings settings;
  if (const int threads = threads_of(line); threads > 0) settings.set_num_threads(threads);
  if (const auto cores = static_cast<int>(std::thread::hardware_concurrency());
      cores > 0 && line.threads > cores)
    report::warn("--threads {} on {} cores: threads that share a core wait for each other",
                 line.threads, cores);
  // Ranks that share cores were asked for: a warning from each would bury the run's own lines.
  if (rank_count(MPI_COMM_WORLD) > 1) settings.set_disable_warnings(true);
  const Kokkos::ScopeGuard kokkos(settings);
  return work();
}

int execute(const CommandLine& line) {
  switch (line.command) {
    case Command::run:
      return with_kokkos(line, [&] { return run_command(line); });
    case Command::check:
      if (line.resolved_only) return run_check(line, std::cout);
      return with_kokkos(line, [&] { return run_check(line, std::cout); });
    case Command::keys:
      std::cout << (line.schema            ? case_schema()
                    : line.section.empty() ? keys_page()
                                           : keys_text(line.section));
      break;
    case Command::info:
      std::cout << as_input([&] { return describe_path(line.file); });
      break;
    case Command::new_case:
      if (rank_of(MPI_COMM_WORLD) == 0) std::cout << make_new_case(line.new_case);
      break;
    case Command::none:
      if (rank_of(MPI_COMM_WORLD) == 0) std::cout << line.text;
  }
  return 0;
}

/// Reports a problem once and ends all ranks. Rank 0 tells a problem that all of them met and ends
/// the others; a rank that met one alone tells it a moment later.
int fail(const std::string& words, int exit_code) {
  const std::string message = printable_lines(words);
  const int rank = rank_of(MPI_COMM_WORLD);
  if (rank == 0) {
    report::error("{}", message);
  } else {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    std::cerr << "error: rank " + std::to_string(rank) + ": " + message + "\n" << std::flush;
  }
  if (rank_count(MPI_COMM_WORLD) > 1) MPI_Abort(MPI_COMM_WORLD, exit_code);
  return exit_code;
}

/// Reports bad input. All ranks end quietly where all read the same; a file may also be missing on
/// one node.
int refuse(const MpiScope& mpi, const std::string& message) {
  constexpr int bad_input = 2;
  if (!all_come(mpi.refusals, std::chrono::seconds(2))) return fail(message, bad_input);
  if (rank_of(MPI_COMM_WORLD) == 0) std::cerr << printable_lines(message) << '\n';
  return bad_input;
}

}  // namespace
}  // namespace barchan

int main(int argc, char** argv) {
  using namespace barchan;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told like a full disk
  keep_standard_streams();
  const MpiScope mpi(&argc, &argv);
  try {
    const auto line =
        parse_command_line(argc, argv, "barchan " BARCHAN_VERSION " (" BARCHAN_GIT_HASH ")");
    report::start(line.shown, rank_of(MPI_COMM_WORLD));
    // A reader of its output that goes away must not cost the results of a run.
    if (line.command == Command::run) std::signal(SIGPIPE, SIG_IGN);
    const int code = execute(line);
    if (line.command != Command::run && !std::cout.flush())
      throw std::runtime_error("cannot write to the terminal or where it leads");
    return code;
  } catch (const InputError& problem) {
    return refuse(mpi, problem.what());
  } catch (const std::exception& problem) {
    if (!is_out_of_memory(problem)) return fail(problem.what(), 1);
    return fail(
        "there is not enough memory on this machine (./barchan check says what a case needs): "
        "take fewer fluid.cells or grains, or more ranks on more machines",
        1);
  }
}
