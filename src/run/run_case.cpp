// The command run.
#include <unistd.h>

#include "src/config/derived.hpp"
#include "src/config/load.hpp"
#include "src/config/validate.hpp"
#include "src/parallel/communicator.hpp"
#include "src/run/commands.hpp"
#include "src/run/simulation.hpp"
#include "src/run/starts.hpp"
#include "src/run/watchdog.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

/// The case was stopped on request, or one that it starts from.
struct Stopped {};

/// What follows from the case, and what looks wrong in it.
void show_numbers(const Config& config, const std::vector<SizeClass>& sizes) {
  report::info("{}", to_text(derive(config, sizes)));
  for (const Finding& f : validate(config, sizes)) {
    if (f.severity == Finding::Severity::warning) report::warn("{}: {}", f.keys.front(), f.message);
  }
}

void run_one(const Config& config, const RunOptions& options);

/// The file a case starts from. Where that is the last state of another case, in a .toml, that case
/// is run in the same realisation, or run to its end, if the state is missing.
fs::path start_file(const fs::path& source, const fs::path& beside, int realisation) {
  if (source.extension() != ".toml") return source.extension().empty() ? fs::path() : source;
  const StartCase start = start_case(source, beside, realisation);
  const auto& [first, config, folder, begun, done] = start;
  // All ranks act on what rank 0 sees: the run that one starts changes what another would find.
  if (!broadcast(done, MPI_COMM_WORLD)) {
    report::info("first the case it starts from: {} -> {}", config.title, folder.string());
    auto restart = begun ? latest_checkpoint(folder) : std::nullopt;
    if (!restart && config.time.end > first.time.end)  // the same flow some time later
      restart = start_file(source, beside, realisation - 1);
    run_one(config, {.folder = folder, .restart = restart});
  }
  const auto state = latest_checkpoint(folder);
  if (!state) throw std::runtime_error(folder.string() + " holds no restart file to start from");
  return *state;
}

/// The files a case starts from; what is missing of them is run.
InitialFiles start_files(const Config& config, const fs::path& folder) {
  const fs::path beside = fs::absolute(folder).parent_path();
  InitialFiles files;
  const InitialConfig& start = config.initial;
  if (config.fluid) files.fluid = start_file(start.fluid, beside, start.realisation);
  if (config.grains) files.grains = start_file(start.grains, beside, start.realisation);
  return files;
}

/// Refuses what this machine cannot hold, before it is asked for the memory.
void check_memory(const Config& config, const std::vector<SizeClass>& sizes) {
  const double need = derive(config, sizes).memory / rank_count(MPI_COMM_WORLD);
  const double have = memory_of_machine();
  if (need <= have) return;
  throw InputError(fmt::format(
      "{}: this case needs about {:.3g} GB a rank, and this machine has {:.3g} GB: take fewer "
      "fluid.cells or grains, or more ranks on more machines",
      config.file.string(), need / 1e9, have / 1e9));
}

/// Before hours go into what a case starts from. Rank 0 looks, all end if it finds something.
void check_folder(const Config& config, const RunOptions& options) {
  std::string problem;
  try {
    if (rank_of(MPI_COMM_WORLD) == 0) {
      check_out_folder(options.folder);
      if (options.restart) {
        check_results_go_on(options.folder);
      } else {
        check_nothing_is_lost(config, options.folder);
      }
    }
  } catch (const InputError& found) {
    problem = found.what();
  }
  if (broadcast(!problem.empty(), MPI_COMM_WORLD)) throw InputError(problem);
}

void run_one(const Config& config, const RunOptions& options) {
  const auto sizes =
      options.restart ? known_sizes(config) : grains_ahead(config, options.folder).sizes;
  check_memory(config, sizes);
  check_folder(config, options);
  const InitialFiles files = options.restart ? InitialFiles{} : start_files(config, options.folder);
  report::stop_log();
  report::info("{}", config.title);
  Watchdog::beat("setting up");
  Watchdog::last_good_restart(options.restart.value_or(fs::path()));
  Simulation simulation = as_input([&] { return Simulation(config, options, files); });
  simulation.open_folder();
  show_numbers(config, sizes);
  try {
    if (simulation.run() == Outcome::stopped) throw Stopped{};
  } catch (const std::exception& problem) {
    const auto last = simulation.last_restart();
    throw std::runtime_error(std::string(problem.what()) +
                             (last ? "; the last good restart is " + last->string() : ""));
  }
}

}  // namespace

double memory_of_machine() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

fs::path run_folder(const CommandLine& line) {
  return line.out.value_or(fs::path("runs") / line.file.stem());
}

int run_command(const CommandLine& line) {
  const Watchdog watchdog(line.patience, MPI_COMM_WORLD);
  const Config config = load_config(line.file, line.overrides);
  if (line.dry_run) {
    report::info("{}", config.title);
    show_numbers(config, grains_ahead(config, run_folder(line)).sizes);
    report::info("nothing was run (--dry-run)");
    return 0;
  }
  const RunOptions options{.folder = run_folder(line), .restart = line.restart};
  try {
    if (line.starts_only) {
      start_files(config, options.folder);
    } else {
      run_one(config, options);
      report::info("results in {}", options.folder.string());
    }
    return 0;
  } catch (const Stopped&) {
    return 3;
  }
}

}  // namespace barchan
