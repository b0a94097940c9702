#include "src/app/run_case.hpp"

#include <nlohmann/json.hpp>
#include <thread>

#include "src/app/memory.hpp"
#include "src/app/starts.hpp"
#include "src/base/stop_request.hpp"
#include "src/base/words.hpp"
#include "src/case/derived.hpp"
#include "src/case/load.hpp"
#include "src/io/folder_lock.hpp"
#include "src/parallel/communicator.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/run/case_inputs.hpp"
#include "src/run/simulation.hpp"
#include "src/run/watchdog.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

/// Stop on request of the case, or of one that it starts from.
struct Stopped {};

/// Ends the program if a stop was asked for before there is a state that a restart file could hold.
void end_if_asked() {
  if (!any_rank(stop_signal != 0, MPI_COMM_WORLD)) return;
  report::info("stopped on request; the same command goes on");
  throw Stopped{};
}

void warn_of(const Case& the_case, const std::vector<SizeClass>& sizes) {
  for (const std::string& warning : case_warnings(the_case, sizes)) report::warn("{}", warning);
}

std::string numbers_of(const SettledCase& the_case) {
  return to_text(the_case.numbers) + memory_line(the_case.config, the_case.sizes);
}

enum class Role { asked_for, precursor };
void run_locked(const Case& the_case, const RunOptions& options, Role role);

/// Throws InputError on all ranks if `check` does so on rank 0, which looks at the disk for all.
template <class Check>
void check_on_root(const Check& check) {
  std::string problem;
  try {
    if (rank_of(MPI_COMM_WORLD) == 0) check();
  } catch (const InputError& found) {
    problem = found.what();
  }
  if (broadcast(!problem.empty(), MPI_COMM_WORLD)) throw InputError(problem);
}

/// Checks the place of the results before the folder is made or locked, and before hours go into
/// what the case starts from.
void check_place(const Config& config, const RunOptions& options) {
  check_on_root([&] {
    check_out_folder(options.folder);
    if (!options.restart) check_nothing_is_lost(config, options.folder);
  });
}

/// Lock of a folder, on rank 0; empty if another process has it.
std::optional<FolderLock> try_to_lock(const fs::path& folder) {
  std::optional<FolderLock> lock;
  check_on_root([&] {
    if (auto taken = FolderLock::take(folder)) lock.emplace(std::move(*taken));
    if (lock && !lock->enforced()) {
      report::warn("{}: this file system has no locks: a second run in it would not be noticed",
                   folder.string());
    }
  });
  return lock;
}

/// Waits until no other process computes in the folder.
std::optional<FolderLock> wait_for_lock(const fs::path& folder) {
  using namespace std::chrono_literals;
  for (bool told = false;; told = true) {
    auto lock = try_to_lock(folder);
    if (broadcast(lock.has_value(), MPI_COMM_WORLD)) return lock;
    if (!told)
      report::info("{} is being computed by {}; waiting", folder.string(),
                   FolderLock::holder_of(folder));
    catch_stop_signals();
    end_if_asked();
    Watchdog::heartbeat("waiting for a case that another process runs");
    std::this_thread::sleep_for(500ms);
  }
}

/// Sets aside the results of another start in its folder: nobody asked for their end, so they stay
/// under another name.
void set_aside(const fs::path& folder, const EarlierRun& earlier) {
  check_on_root([&] {
    fs::path kept = folder;
    for (int n = 1; fs::exists(kept); ++n) kept = fmt::format("{}.old{}", folder.string(), n);
    fs::rename(folder, kept);
    fs::remove(FolderLock::file_in(kept));  // ours, which would find it no more
    report::info("{} has results {}: they are now in {}", folder.string(), earlier.difference(),
                 kept.string());
  });
}

/// Runs a start, or goes on with it, unless somebody else has done so while we waited.
void make_start(const Case& source, const fs::path& runs, int realisation) {
  for (;;) {
    const StartCase start = start_case(source, runs, realisation);
    check_place(start.realised.config, {.folder = start.folder, .restart = start.earlier.restart});
    const auto lock = wait_for_lock(start.folder);
    const auto& [realised, folder, earlier] = start_case(source, runs, realisation);
    // All ranks act on what rank 0 sees: the run that one starts changes what another would find.
    if (broadcast(earlier.done(), MPI_COMM_WORLD)) return;
    if (broadcast(!earlier.same() && earlier.is_worth_keeping(), MPI_COMM_WORLD)) {
      set_aside(folder, earlier);
      continue;
    }
    run_locked(realised,
               {.folder = folder, .restart = earlier.same() ? earlier.restart : std::nullopt},
               Role::precursor);
    return;
  }
}

/// File with the last state of a case. Runs the case in this realisation, or to its end, if the
/// file is missing.
fs::path start_file(const Case& source, const fs::path& runs, int realisation) {
  const bool done = start_case(source, runs, realisation).earlier.done();
  if (!broadcast(done, MPI_COMM_WORLD)) make_start(source, runs, realisation);
  const StartCase start = start_case(source, runs, realisation);
  if (!start.earlier.done())
    throw std::runtime_error(start.folder.string() + " holds no restart file to start from");
  return *start.earlier.restart;
}

/// Files that a case starts from; missing ones are computed.
InitialFiles start_files(const Case& the_case, const fs::path& folder) {
  const Config& config = the_case.config;
  const fs::path runs = folder_of_runs(config.file, folder);
  const InitialConfig& initial = config.initial;
  const auto file = [&](const fs::path& source, const std::shared_ptr<const Case>& start) {
    if (start) return start_file(*start, runs, initial.realisation);
    return source.extension().empty() ? fs::path() : source;
  };
  InitialFiles files;
  if (config.fluid) files.fluid = file(initial.fluid, the_case.flow_start);
  if (config.grains) files.grains = file(initial.grains, the_case.grain_start);
  const nlohmann::json inputs = as_input([&] { return inputs_to_record(the_case, folder); });
  if (!inputs.is_null())
    files.record = inputs.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
  return files;
}

/// Warns that an input file has changed: a run that goes on began from the old content, and so do
/// its results.
void tell_changed_input(const Case& the_case, const std::string& record) {
  const auto recorded =
      record.empty() ? nlohmann::json() : nlohmann::json::parse(record, nullptr, false);
  if (const auto changed = as_input([&] { return changed_input(recorded, the_case); })) {
    report::warn("{} has changed: the run goes on from what began with its earlier content",
                 changed->string());
  }
}

/// Runs a case in a folder that this process has locked.
void run_locked(const Case& the_case, const RunOptions& options, Role role) {
  const Config& config = the_case.config;
  SettledCase settled = the_case;
  if (!options.restart) settled = planned_grains(the_case, options.folder).settled;
  check_memory(config, settled.sizes);
  check_on_root([&] {
    check_is_ours(config, options.folder);
    if (options.restart) check_results_go_on(options.folder);
  });
  const InitialFiles files =
      options.restart ? InitialFiles{} : start_files(the_case, options.folder);
  end_if_asked();
  report::stop_log();
  report::info("{}{} -> {}", role == Role::precursor ? "first the case it starts from: " : "",
               config.title, shown(options.folder));
  Watchdog::heartbeat("setting up");
  Watchdog::last_good_restart(options.restart.value_or(fs::path()));
  Simulation simulation = as_input([&] { return Simulation(settled, options, files); });
  simulation.open_folder();
  if (options.restart) tell_changed_input(the_case, simulation.inputs());
  report::info("  {}", summary(settled.numbers));
  report::details(numbers_of(settled));
  warn_of(the_case, settled.sizes);
  try {
    if (simulation.run() == Outcome::stopped) throw Stopped{};
  } catch (const std::exception& problem) {
    const auto last = simulation.last_restart();
    throw std::runtime_error(std::string(problem.what()) +
                             (last ? "; the last good restart is " + last->string() : ""));
  }
}

/// File that --restart names: a file, the last one in a folder, or with "latest" the last one of
/// the run.
std::optional<fs::path> named_restart(const CommandLine& line) {
  if (!line.restart) return std::nullopt;
  std::error_code error;
  const bool latest = *line.restart == "latest" && !fs::exists(*line.restart, error);
  if (!latest && !fs::is_directory(*line.restart, error)) return line.restart;
  const fs::path folder = latest ? run_folder(line) : *line.restart;
  const auto last = latest_checkpoint(folder);
  if (!last)
    throw InputError(fmt::format("--restart {}: {} holds no restart file", line.restart->string(),
                                 shown(folder)));
  return last;
}

/// Runs the case that was asked for, unless its results are there. Nothing that took time is
/// removed unless the user said so.
void run_one(const Case& the_case, RunOptions options, const CommandLine& line) {
  const Config& config = the_case.config;
  const fs::path& folder = options.folder;
  if (line.resume) options.restart = latest_checkpoint(folder);
  check_place(config, options);
  if (!options.restart && !line.overwrite)
    check_on_root([&] { check_earlier_places(the_case, folder); });
  const auto lock = try_to_lock(folder);
  if (!broadcast(lock.has_value(), MPI_COMM_WORLD)) {
    throw InputError(fmt::format("{} is in use by {}: wait for it, or take another --out",
                                 folder.string(), FolderLock::holder_of(folder)));
  }
  if (line.resume || (!options.restart && !line.overwrite)) {
    const EarlierRun earlier = earlier_run(the_case, folder);
    if (broadcast(earlier.done(), MPI_COMM_WORLD)) {
      report::info("{} already holds this run, finished; --overwrite computes it again",
                   folder.string());
      return;
    }
    if (line.resume) options.restart = earlier.restart;  // another process may have gone on
    if (!options.restart) check_on_root([&] { check_overwrites_nothing(earlier, folder); });
  }
  if (options.restart) report::info("going on from {}", shown(*options.restart));
  run_locked(the_case, options, Role::asked_for);
}

}  // namespace

fs::path run_folder(const CommandLine& line) {
  return line.out.value_or(fs::path("runs") / case_name(line.file));
}

int run_command(const CommandLine& line) {
  const Watchdog watchdog(line.patience, MPI_COMM_WORLD);
  const Case the_case = load_case_of(line);
  const Config& config = the_case.config;
  if (line.dry_run) {
    report::info("{}", config.title);
    const SettledCase settled = planned_grains(the_case, run_folder(line)).settled;
    report::info("{}", numbers_of(settled));
    warn_of(the_case, settled.sizes);
    report::info("nothing was run (--dry-run)");
    return 0;
  }
  const RunOptions options{.folder = run_folder(line), .restart = named_restart(line)};
  try {
    if (line.starts_only) {
      start_files(the_case, options.folder);
    } else {
      run_one(the_case, options, line);
      report::info("results in {}", options.folder.string());
    }
    return 0;
  } catch (const Stopped&) {
    return 3;
  }
}

}  // namespace barchan
