// Measurements during a run.
#pragma once

#include "src/diagnostics/bed_load.hpp"
#include "src/diagnostics/dune_analytics.hpp"
#include "src/diagnostics/flow_average.hpp"
#include "src/diagnostics/flow_statistics.hpp"
#include "src/diagnostics/force_map.hpp"
#include "src/diagnostics/heap_shares.hpp"
#include "src/diagnostics/probes.hpp"
#include "src/results/output_files.hpp"
#include "src/run/run_state.hpp"

namespace barchan {

/// Dunes, and means of the flow and of the forces over time. All ranks call every member together.
class RunDiagnostics {
 public:
  explicit RunDiagnostics(const RunState& run);

  /// Dunes now, in order of label, on rank 0; empty on others.
  std::vector<DuneRecord> find_dunes();
  /// Heaps that the grains of the dunes last found came from, on rank 0; empty on others.
  const std::vector<HeapShare>& heap_shares() const { return heap_shares_; }
  /// Label of the dune of each grain of this rank, as in dune.csv if find_dunes() was called at
  /// this step; -1: in none.
  std::vector<int> dune_labels() const;
  /// Largest of the dunes last found.
  const std::optional<DuneRecord>& largest_dune() const { return largest_dune_; }

  /// Puts the edge of a window that follows its dune half a box away from the largest dune; without
  /// a dune it stays where it is.
  void place_window_edge(GrainState& grains) const;

  /// Tells if a sample is due: from statistics.start on, every statistics.interval.
  bool sample_due() const;
  /// Adds the present state to the means.
  void sample();
  /// Probes of the case; nullptr without any.
  Probes* probes() { return probes_ ? &*probes_ : nullptr; }
  /// Writes statistics.csv, flow_average.h5, force_map.csv and bedload.csv.
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
  std::optional<BedLoad> bed_load_;
  std::optional<Probes> probes_;
};

}  // namespace barchan
