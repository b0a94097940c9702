// A run in memory: the case, its state, what advances it, how far it has come, and its accounts.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "src/base/errors.hpp"
#include "src/base/report.hpp"
#include "src/coupling/coupled_step.hpp"
#include "src/diagnostics/dune_shape.hpp"
#include "src/io/checkpoint.hpp"
#include "src/parallel/exchange.hpp"
#include "src/run/initial_state.hpp"

namespace barchan {

/// Time in fluid steps.
struct RunClock {
  double fluid_step = 0;                      // [s]
  std::int64_t step = 0, start = 0, end = 0;  // now; where this run began and ends

  double time() const { return static_cast<double>(step) * fluid_step; }  // [s]
  std::int64_t steps_done() const { return step - start; }
  /// True at the start of a case and every `interval` [s] (a whole number of steps, at least one);
  /// never if that is 0.
  bool due(double interval) const {
    if (!(interval > 0)) return false;
    const double steps = std::min(interval / fluid_step, 1e18);
    return step % std::max<std::int64_t>(1, std::llround(steps)) == 0;
  }
};

struct RunState {
  /// Starts a new run, or goes on from a restart file; see Simulation. All ranks together.
  RunState(const Config& config, const CheckpointReader* restart, const InitialFiles& files);
  /// Starts from a state that was made for it, with the same `pencils`.
  RunState(const Config& config, std::unique_ptr<const Decomposition> pencils, SystemState state);

  /// One fluid step.
  void advance();

  MPI_Comm ranks = MPI_COMM_WORLD;
  Config config;
  Provenance provenance;
  RunClock clock;
  std::unique_ptr<const Decomposition> pencils;  // none: one rank has all of the grid
  std::vector<std::string> changed_config;       // keys, since the restart file was written
  SystemState state;
  CoupledStep coupled_step;
  std::int64_t n_grains = 0;           // inside, of all ranks
  std::optional<double> restart_time;  // [s]; none: a new run

 private:
  void go_on_from(const CheckpointReader& file);
  void count_grains();
};

/// Sums and extremes over fluid steps.
struct FluidStepSums {
  std::int64_t steps = 0, iterations = 0, max_iterations = 0;
  double continuity_residual = 0, courant = 0;  // largest [1/s], [-]
  double impulse_on_grains = 0;                 // of the flow along x [N s]

  void add(const FluidStepReport& report, double fluid_step, double impulse);
  double mean_iterations() const {
    return static_cast<double>(iterations) / std::max<double>(1, static_cast<double>(steps));
  }
};

/// Sums, extremes and rates for history.csv, the progress line and run.json.
struct RunAccounts {
  FluidStepSums interval, all;        // since the last row of history.csv; since begin()
  double max_overlap = 0;             // over the mean diameter of the pair
  double grain_step_over_stable = 0;  // largest
  std::int64_t grain_steps = 0;
  Phases phases;  // wall time, besides those of the coupled step
  WallClock::time_point start = WallClock::now();
  MessageCounts messages_at_start;

  /// Wall time and messages count from now on.
  void begin();
  /// The interval in restart files; those of earlier versions have none.
  void save(CheckpointWriter& file) const;
  void load(const CheckpointReader& file);
  Progress progress(const RunState& run, const std::optional<DuneRow>& largest_dune) const;
  /// run.json. `status`: "running", "done", "stopped" or "failed"; `message`: why it stopped or
  /// failed. Wall seconds of phases are per fluid step, what is communicated is of this rank.
  nlohmann::ordered_json summary(const RunState& run, const std::string& status,
                                 const std::string& message) const;
};

}  // namespace barchan
