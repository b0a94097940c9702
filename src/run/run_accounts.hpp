// The accounts of a run: sums, extremes and rates for history.csv, the progress line and run.json.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "src/base/report.hpp"
#include "src/base/stopwatch.hpp"
#include "src/parallel/exchange.hpp"
#include "src/run/run_state.hpp"

namespace barchan {

/// Sums and extremes of the fluid steps since the last row of history.csv.
struct HistoryInterval {
  std::int64_t steps = 0, iterations = 0;
  double continuity_residual = 0, courant = 0;  // largest [1/s], [-]
  double mean_iterations() const {
    return steps > 0 ? static_cast<double>(iterations) / static_cast<double>(steps) : 0;
  }
};

class RunAccounts {
 public:
  /// Wall time and messages count from now on.
  void begin();
  double wall_seconds() const { return seconds_since(wall_start_); }
  /// Wall time by phase, besides those of the coupled step.
  Phases& phases() { return phases_; }

  /// `n` grains are about to be advanced by `substeps`.
  void add_grain_steps(std::int64_t n, int substeps) { grain_steps_ += n * substeps; }
  /// The fluid step that was just made.
  void add_fluid_step(const FluidStepReport& report, double fluid_step);
  void add_overlap(double overlap) { max_overlap_ = std::max(max_overlap_, overlap); }

  const HistoryInterval& interval() const { return interval_; }
  void begin_interval() { interval_ = {}; }
  /// The interval in restart files; those of earlier versions have none.
  void save(CheckpointWriter& file) const;
  void load(const CheckpointReader& file);

  Progress progress(const RunState& run) const;
  /// run.json. `status`: "running", "done", "stopped" or "failed"; `message`: why it stopped or
  /// failed. Wall seconds of phases are per fluid step, what is communicated is of this rank.
  nlohmann::ordered_json summary(const RunState& run, const std::string& status,
                                 const std::string& message) const;

 private:
  HistoryInterval interval_;
  Phases phases_;
  WallClock::time_point wall_start_ = WallClock::now();
  MessageCounts messages_at_start_;
  std::int64_t grain_steps_ = 0;
  std::int64_t iterations_sum_ = 0, iterations_max_ = 0;
  double max_courant_ = 0, max_overlap_ = 0, max_residual_ = 0;
};

}  // namespace barchan
