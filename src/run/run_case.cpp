#include "src/run/run_case.hpp"

#include <unistd.h>

#include "src/base/errors.hpp"
#include "src/base/report.hpp"
#include "src/config/derived.hpp"
#include "src/config/load.hpp"
#include "src/config/validate.hpp"
#include "src/io/checkpoint.hpp"
#include "src/parallel/communicator.hpp"
#include "src/run/out_folder.hpp"
#include "src/run/run_folder.hpp"
#include "src/run/simulation.hpp"
#include "src/run/watchdog.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

/// A start that was stopped on request stops the case that wanted it.
struct StoppedInPrerequisite {};

bool is_toml(const std::string& source) { return fs::path(source).extension() == ".toml"; }

/// True if `folder` holds the finished run of exactly this configuration.
bool is_finished(const fs::path& folder, const Config& config) {
  return is_written_in(folder / "config.toml", config) && status_in(folder / "run.json") == "done";
}

/// Restart file of an unfinished run of the same configuration.
std::optional<fs::path> unfinished(const fs::path& folder, const Config& config) {
  if (!is_written_in(folder / "config.toml", config)) return {};
  return latest_checkpoint(folder);
}

void show_warnings(const Config& config, const std::vector<SizeClass>& sizes) {
  for (const Finding& f : validate(config, sizes)) {
    if (f.severity == Finding::Severity::warning) report::warn("{}: {}", f.keys.front(), f.message);
  }
}

Outcome run_one(const Config& config, const RunOptions& options);

/// Last state of the case in `toml`, which is run, or run to its end, where that is missing.
fs::path final_state(const std::string& toml, const fs::path& beside) {
  const Config config = load_config(toml);
  const fs::path folder = beside / fs::path(toml).stem();
  // All ranks act on what rank 0 sees: the run that one starts changes what another would find.
  if (!broadcast(is_finished(folder, config), MPI_COMM_WORLD)) {
    report::info("first the case it starts from: {} -> {}", config.title, folder.string());
    const auto restart = unfinished(folder, config);
    if (run_one(config, {.folder = folder, .restart = restart}) == Outcome::stopped) {
      throw StoppedInPrerequisite{};
    }
  }
  const auto state = latest_checkpoint(folder);
  if (!state) throw std::runtime_error(folder.string() + " holds no restart file to start from");
  return *state;
}

fs::path start_file(const std::string& source, const fs::path& beside) {
  if (is_toml(source)) return final_state(source, beside);
  return fs::path(source).extension().empty() ? fs::path{} : fs::path(source);
}

/// The files a case starts from; what is missing of them is run.
InitialFiles start_files(const Config& config, const fs::path& folder) {
  const fs::path beside = fs::absolute(folder).parent_path();
  InitialFiles files;
  if (config.fluid) files.fluid = start_file(config.initial.fluid, beside);
  if (config.grains) files.grains = start_file(config.initial.grains, beside);
  return files;
}

/// Refuses what this machine cannot hold, before it is asked for the memory.
void check_memory(const Config& config, const std::vector<SizeClass>& sizes) {
  const double need = derive(config, sizes).memory / rank_count(MPI_COMM_WORLD);
  const double have =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (need <= have) return;
  throw InputError(fmt::format(
      "{}: this case needs about {:.3g} GB a rank, and this machine has {:.3g} GB: take fewer "
      "fluid.cells or grains, or more ranks on more machines",
      config.file.string(), need / 1e9, have / 1e9));
}

/// Rank 0 looks, all end if it finds something.
template <class Check>
void on_rank_0(const Check& check) {
  std::string problem;
  try {
    if (rank_of(MPI_COMM_WORLD) == 0) check();
  } catch (const InputError& found) {
    problem = found.what();
  }
  if (broadcast(!problem.empty(), MPI_COMM_WORLD)) throw InputError(problem);
}

/// Before hours go into what a case starts from.
void check_folder(const Config& config, const RunOptions& options) {
  on_rank_0([&] {
    check_out_folder(options.folder);
    if (options.restart) {
      check_results_go_on(options.folder);
    } else {
      check_nothing_is_lost(config, options.folder);
    }
  });
}

Outcome run_one(const Config& config, const RunOptions& options) {
  check_memory(config, known_sizes(config));
  check_folder(config, options);
  const InitialFiles files = options.restart ? InitialFiles{} : start_files(config, options.folder);
  report::stop_log();
  report::info("{}", config.title);
  Watchdog::beat("setting up");
  Watchdog::last_good_restart(options.restart.value_or(fs::path()));
  Simulation simulation(config, options, files);
  simulation.open_folder();
  const auto sizes = known_sizes(config);
  report::info("{}", to_text(derive(config, sizes)));
  show_warnings(config, sizes);
  try {
    return simulation.run();
  } catch (const std::exception& problem) {
    const auto last = simulation.last_restart();
    throw std::runtime_error(std::string(problem.what()) +
                             (last ? "; the last good restart is " + last->string() : ""));
  }
}

}  // namespace

fs::path default_run_folder(const fs::path& config_file) {
  return fs::path("runs") / config_file.stem();
}

int run_command(const CommandLine& line) {
  const Watchdog watchdog(line.patience, MPI_COMM_WORLD);
  const Config config = load_config(line.file, line.overrides);
  if (line.dry_run) {
    const auto sizes = known_sizes(config);
    report::info("{}\n{}", config.title, to_text(derive(config, sizes)));
    show_warnings(config, sizes);
    report::info("nothing was run (--dry-run)");
    return 0;
  }
  const RunOptions options{.folder = line.out.value_or(default_run_folder(line.file)),
                           .restart = line.restart};
  try {
    if (line.starts_only) {
      start_files(config, options.folder);
      return 0;
    }
    const Outcome outcome = run_one(config, options);
    if (outcome == Outcome::done) report::info("results in {}", options.folder.string());
    return outcome == Outcome::done ? 0 : 3;
  } catch (const StoppedInPrerequisite&) {
    return 3;
  }
}

}  // namespace barchan
