// Simulation of a case: the time loop, from the first step to an outcome.
#pragma once

#include "src/coupling/state_checks.hpp"
#include "src/run/results_writer.hpp"

namespace barchan {

struct RunOptions {
  std::filesystem::path folder;                  // folder of the run
  std::optional<std::filesystem::path> restart;  // restart file to go on from
};

/// Outcome of a run.
enum class Outcome { done, stopped };

/// Owns the state and the run folder. Members throw std::runtime_error with a sentence for the
/// user; the summary then says "failed". All ranks call them together.
class Simulation {
 public:
  /// Reads and checks all that the run starts from, and writes nothing: every exception is about
  /// input (as_input).
  Simulation(const SettledCase& the_case, const RunOptions& options, const InitialFiles& files);

  /// Makes the folder ready: see ResultsWriter.
  void open_folder();

  /// Runs to the end of the configured time, or until a signal or the wall-clock limit.
  Outcome run();

  /// Last restart file written, or the one the run went on from; if any.
  std::optional<std::filesystem::path> last_restart() const;
  const SystemState& state() const { return run_.state; }
  /// Inputs that the run began from, as in Provenance.
  const std::string& inputs() const { return run_.provenance.inputs; }

 private:
  void follow_first_dune(const std::string& source);
  Outcome loop();
  void one_step();
  std::string reason_to_stop() const;
  void say_failed(const std::string& message);

  RunOptions options_;
  std::unique_ptr<CheckpointReader> restart_;  // open while the run is built
  RunState run_;
  RunDiagnostics diagnostics_;
  RunAccounts accounts_;
  StateChecks state_checks_;
  std::optional<ResultsWriter> results_;  // once open_folder() was called
  ProgressLine progress_;
};

}  // namespace barchan
