// What a run measures as it goes, what it writes, and when.
#pragma once

#include "src/diagnostics/dune_analytics.hpp"
#include "src/diagnostics/flow_average.hpp"
#include "src/diagnostics/flow_statistics.hpp"
#include "src/diagnostics/force_map.hpp"
#include "src/output/output_files.hpp"
#include "src/run/run_folder.hpp"
#include "src/run/run_state.hpp"

namespace barchan {

/// The dunes, and means of the flow and of the forces over time. All ranks call every member
/// together.
class RunDiagnostics {
 public:
  explicit RunDiagnostics(const RunState& run);

  /// The dunes now, in order of label, on rank 0; nothing on others.
  std::vector<DuneRow> find_dunes();
  /// Of each grain of this rank the label of its dune, as in dune.csv if find_dunes() was called at
  /// this step; -1: in none.
  std::vector<int> dune_labels() const;
  /// The largest of the dunes last found.
  const std::optional<DuneRow>& largest_dune() const { return largest_dune_; }

  /// From statistics.start on, every statistics.interval.
  bool sample_due() const;
  /// Adds the state of now to the means.
  void sample();
  /// statistics.csv, flow_average.h5 and force_map.csv.
  void write(const std::filesystem::path& folder, const OutputFiles& output);

  void save(CheckpointWriter& file) const;
  void load(const CheckpointReader& file);

 private:
  const RunState& run_;
  DuneTracker tracker_;
  std::optional<DuneRow> largest_dune_;
  std::optional<FlowStatistics> statistics_;
  std::optional<FlowAverage> flow_average_;
  std::optional<ForceMap> force_map_;
};

/// Tables, frames, restart files and summary of a run that it refers to. All ranks call every
/// member together. Members throw std::runtime_error with a sentence for the user.
class ResultsWriter {
 public:
  /// Makes the folder ready: removes the results of an earlier run, or those later than the
  /// restart. Log lines go to its log.txt from now on.
  ResultsWriter(const std::filesystem::path& folder, RunState& run, RunDiagnostics& diagnostics,
                RunAccounts& accounts);

  /// Everything whose interval ends with the present step.
  void write_due();
  /// A restart file, and the means over time up to it.
  void write_restart();
  /// run.json.
  void write_summary(const std::string& status, const std::string& message);
  /// Files to look at what went wrong in. Returns the message for the user with their names: that
  /// they cannot be written must not hide why the run failed.
  std::string write_failure(const StateError& problem) const;

 private:
  double check_grain_step();
  void write_history();
  void write_frames();
  bool restart_due() const;

  RunState& run_;
  RunDiagnostics& diagnostics_;
  RunAccounts& accounts_;
  std::filesystem::path folder_;
  OutputFiles output_;
  WallClock::time_point last_restart_ = WallClock::now();
};

}  // namespace barchan
