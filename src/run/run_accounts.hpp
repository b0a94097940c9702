// Counts and times of a run for history.csv, the progress line and run.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "src/base/report.hpp"
#include "src/parallel/exchange.hpp"
#include "src/run/body_sums.hpp"
#include "src/run/run_state.hpp"

namespace barchan {

/// Sums and extremes over fluid steps.
struct FluidStepSums {
  std::int64_t steps = 0, iterations = 0, max_iterations = 0;
  double continuity_residual = 0, courant = 0;  // largest [1/s], [-]
  Vec3 impulse_on_grains;                       // impulse of the flow [N s]

  void add(const FluidStepReport& report, double fluid_step, const Vec3& impulse);
  double mean_iterations() const {
    return static_cast<double>(iterations) / std::max<double>(1, static_cast<double>(steps));
  }
};

/// Warning about a feed whose grains have found no place; empty: nothing is wrong.
std::string unfed_grains(const RunState& run);

/// Sums, extremes and rates for history.csv, the progress line and run.json.
struct RunAccounts {
  FluidStepSums interval, all;        // since the last row of history.csv; since begin()
  BodySums bodies{0};                 // since the last lines of bodies.csv
  double max_overlap = 0;             // over the mean diameter of the pair
  double grain_step_over_stable = 0;  // largest ratio
  std::int64_t grain_steps = 0;
  Phases phases;  // wall time, besides those of the coupled step
  WallClock::time_point start = WallClock::now();
  MessageCounts messages_at_start;

  /// Begins to count wall time and messages.
  void begin();
  /// Saves and loads the interval in restart files; those of earlier versions have none.
  void save(CheckpointWriter& file) const;
  void load(const CheckpointReader& file);
  Progress progress(const RunState& run, const std::optional<DuneRecord>& largest_dune) const;
  /// Content of run.json. `status`: "running", "done", "stopped" or "failed"; `message`: why it
  /// stopped or failed. Wall seconds of phases are per fluid step; numbers of messages are of this
  /// rank.
  nlohmann::ordered_json summary(const RunState& run, const std::string& status,
                                 const std::string& message) const;
};

}  // namespace barchan
