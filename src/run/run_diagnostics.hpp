// What a run measures as it goes.
#pragma once

#include "src/diagnostics/dune_analytics.hpp"
#include "src/diagnostics/flow_average.hpp"
#include "src/diagnostics/flow_statistics.hpp"
#include "src/diagnostics/force_map.hpp"
#include "src/diagnostics/heap_shares.hpp"
#include "src/diagnostics/probes.hpp"
#include "src/results/output_files.hpp"
#include "src/run/run_state.hpp"

namespace barchan {

/// The dunes, and means of the flow and of the forces over time. All ranks call every member
/// together.
class RunDiagnostics {
 public:
  explicit RunDiagnostics(const RunState& run);

  /// The dunes now, in order of label, on rank 0; nothing on others.
  std::vector<DuneRecord> find_dunes();
  /// Which heaps the grains of the dunes last found came from, on rank 0; nothing on others.
  const std::vector<HeapShare>& heap_shares() const { return heap_shares_; }
  /// Of each grain of this rank the label of its dune, as in dune.csv if find_dunes() was called at
  /// this step; -1: in none.
  std::vector<int> dune_labels() const;
  /// The largest of the dunes last found.
  const std::optional<DuneRecord>& largest_dune() const { return largest_dune_; }

  /// In a window that follows its dune, puts the seam half a box away from the largest of them;
  /// without one it stays where it is.
  void place_seam(GrainState& grains) const;

  /// From statistics.start on, every statistics.interval.
  bool sample_due() const;
  /// Adds the state of now to the means.
  void sample();
  /// The probes of the case; nothing without any.
  Probes* probes() { return probes_ ? &*probes_ : nullptr; }
  /// statistics.csv, flow_average.h5 and force_map.csv.
  void write(const std::filesystem::path& folder, const OutputFiles& output);

  void save(CheckpointWriter& file) const;
  void load(const CheckpointReader& file);

 private:
  const RunState& run_;
  DuneTracker tracker_;
  std::optional<DuneRecord> largest_dune_;
  std::vector<HeapShare> heap_shares_;
  std::optional<FlowStatistics> statistics_;
  std::optional<FlowAverage> flow_average_;
  std::optional<ForceMap> force_map_;
  std::optional<Probes> probes_;
};

}  // namespace barchan
