// Output of a run: what is written, and when.
#pragma once

#include "src/base/errors.hpp"
#include "src/run/ro_crate.hpp"
#include "src/run/run_accounts.hpp"
#include "src/run/run_diagnostics.hpp"
#include "src/run/run_folder.hpp"

namespace barchan {

/// Writer of tables, frames, restart files and summary of a run that it refers to. All ranks call
/// every member together. Members throw std::runtime_error with a sentence for the user.
class ResultsWriter {
 public:
  /// Makes the folder ready: removes the results of an earlier run, or those later than the
  /// restart. Log lines go to its log.txt from now on.
  ResultsWriter(const std::filesystem::path& folder, RunState& run, RunDiagnostics& diagnostics,
                RunAccounts& accounts);

  /// Writes everything whose interval ends with the present step.
  void write_due();
  /// Writes a restart file, and the means over time up to it.
  void write_restart();
  /// Writes run.json, and when the status changes ro-crate-metadata.json.
  void write_summary(const std::string& status, const std::string& message);
  /// Writes files that show what went wrong. Returns the message for the user with their names: a
  /// failure to write them must not hide why the run failed.
  std::string write_failure(const StateError& problem) const;

 private:
  double check_grain_step();
  void write_history();
  void write_bodies();
  void write_probes();
  void write_frames();
  bool restart_due() const;

  RunState& run_;
  RunDiagnostics& diagnostics_;
  RunAccounts& accounts_;
  std::filesystem::path folder_;
  OutputFiles output_;
  WallClock::time_point last_restart_ = WallClock::now();
  int rows_unfed_ = 0;  // successive rows of history.csv in which a feed found no place
  CrateAction action_;  // action of rank 0
};

}  // namespace barchan
