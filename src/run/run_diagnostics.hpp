// What a run measures as it goes: its dunes, and means of the flow and of the forces over time.
#pragma once

#include <optional>
#include <vector>

#include "src/diagnostics/dune_analytics.hpp"
#include "src/diagnostics/flow_average.hpp"
#include "src/diagnostics/flow_statistics.hpp"
#include "src/diagnostics/force_map.hpp"
#include "src/run/run_folder.hpp"
#include "src/run/run_state.hpp"

namespace barchan {

/// All ranks call every member together.
class RunDiagnostics {
 public:
  explicit RunDiagnostics(const RunState& run);

  /// The dunes now, in order of label, on rank 0; nothing on others.
  std::vector<DuneRow> find_dunes(const RunState& run);
  /// Of each grain of this rank the label of its dune, as in dune.csv if find_dunes() was called at
  /// this step; -1: in none.
  std::vector<int> dune_labels(const RunState& run) const;
  /// The largest of the dunes last found.
  const std::optional<DuneRow>& largest_dune() const { return largest_dune_; }

  /// From statistics.start on, every statistics.interval.
  bool sample_due(const RunClock& clock) const;
  /// Adds the state of now to the means.
  void sample(const RunState& run);
  /// statistics.csv, flow_average.h5 and force_map.csv.
  void write(const RunState& run, const RunFolder& folder, const OutputFiles& output);

  void save(CheckpointWriter& file, MPI_Comm ranks) const;
  void load(const CheckpointReader& file);

 private:
  std::optional<StatisticsConfig> config_;
  DuneTracker tracker_;
  std::optional<DuneRow> largest_dune_;
  std::optional<FlowStatistics> statistics_;
  std::optional<FlowAverage> flow_average_;
  std::optional<ForceMap> force_map_;
};

}  // namespace barchan
