// One run: the time loop, and what is written when.
#pragma once

#include <memory>
#include <optional>

#include "src/base/errors.hpp"
#include "src/base/report.hpp"
#include "src/config/config.hpp"
#include "src/coupling/coupled_step.hpp"
#include "src/coupling/state_checks.hpp"
#include "src/diagnostics/dune_analytics.hpp"
#include "src/diagnostics/flow_average.hpp"
#include "src/diagnostics/flow_statistics.hpp"
#include "src/diagnostics/force_map.hpp"
#include "src/output/output_files.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/exchange.hpp"
#include "src/run/initial_state.hpp"
#include "src/run/run_folder.hpp"

namespace barchan {

struct RunOptions {
  std::filesystem::path folder;                  // of the run
  std::optional<std::filesystem::path> restart;  // restart file to go on from
};

/// How a run ended.
enum class Outcome { done, stopped };

/// Owns the state and the run folder. Members throw std::runtime_error with a sentence for the
/// user; the summary then says "failed".
class Simulation {
 public:
  /// Reads and checks all that the run starts from, and writes nothing. Throws InputError when that
  /// cannot be used.
  Simulation(const Config& config, const RunOptions& options, const InitialFiles& files);

  /// Makes the folder ready: removes the results of an earlier run, or those later than the
  /// restart.
  void open_folder();
  /// To the end of the configured time, or until a signal or the wall-clock limit.
  Outcome run();
  /// The last restart file written, or the one the run went on from; if any.
  std::optional<std::filesystem::path> last_restart() const;
  const SystemState& state() const { return state_; }

 private:
  Simulation(const Config& config, const RunOptions& options, const InitialFiles& files,
             std::unique_ptr<const CheckpointReader> restart);
  void go_on_from(const CheckpointReader& file);
  void begin();
  void one_step();
  void write_due(bool first);
  void write_history();
  void write_dunes();
  void write_grains();
  void write_restart();
  void save_statistics(CheckpointWriter& file) const;
  void load_statistics(const CheckpointReader& file);
  void sample_statistics();
  void sample_forces();
  void write_statistics();
  void write_summary(const std::string& status, const std::string& message);
  std::string write_failure(const StateError& problem);
  void say_failed(const std::string& message);
  void watch();
  void count_grains();
  void show_progress();
  double time() const { return static_cast<double>(step_) * config_.time.fluid_step; }
  bool due(double interval) const;
  bool restart_due() const;
  void agree();
  std::map<std::string, double> communication() const;
  RunSummary summary(const std::string& status, const std::string& message) const;

  /// Sums and extremes since the last line of history.csv.
  struct Interval {
    std::int64_t steps = 0, iterations = 0;
    double continuity_residual = 0, courant = 0;
  };

  MPI_Comm ranks_ = MPI_COMM_WORLD;
  Config config_;
  RunOptions options_;
  std::unique_ptr<const Decomposition> pencils_;  // none: one rank has all of the grid
  Provenance provenance_;
  SystemState state_;
  CoupledStep coupled_step_;
  StateChecks state_checks_;
  std::optional<double> restart_time_;
  std::vector<std::string> changed_;  // keys, since the restart file was written
  std::optional<RunFolder> folder_;   // both once open_folder() was called
  std::optional<OutputFiles> output_;
  DuneTracker tracker_;
  std::optional<FlowStatistics> statistics_;
  std::optional<FlowAverage> flow_average_;
  std::optional<ForceMap> force_map_;
  ProgressLine progress_;
  std::optional<DuneRow> largest_dune_;
  Interval interval_;
  Phases phases_;
  WallClock::time_point wall_start_ = WallClock::now(), last_restart_at_ = wall_start_;
  double start_time_ = 0;
  std::int64_t step_ = 0, start_step_ = 0, end_step_ = 0;
  std::int64_t grain_steps_ = 0;
  MessageCounts messages_at_start_;
  std::int64_t n_grains_ = 0;  // inside, of all ranks
  std::int64_t iterations_sum_ = 0, iterations_max_ = 0;
  double max_courant_ = 0, max_overlap_ = 0, max_residual_ = 0;
  bool out_of_time_ = false, stop_requested_ = false, restart_wanted_ = false;  // on all ranks
};

}  // namespace barchan
