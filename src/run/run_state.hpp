// Run in memory: the case, its state, the steps that advance it, its clock, and its accounts.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "src/base/report.hpp"
#include "src/coupling/coupled_step.hpp"
#include "src/diagnostics/dune_shape.hpp"
#include "src/initial/initial_state.hpp"
#include "src/parallel/exchange.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/run/run_clock.hpp"

namespace barchan {

struct RunState {
  /// Starts a new run, or goes on from a restart file; see Simulation. All ranks call it together.
  RunState(const SettledCase& the_case, const CheckpointReader* restart, const InitialFiles& files);
  /// Starts from a state that was made for it, with the same `pencils`.
  RunState(const SettledCase& the_case, std::unique_ptr<const Decomposition> pencils,
           SystemState state);
  RunState(const RunState&) = delete;
  RunState& operator=(const RunState&) = delete;

  /// Advances the state by one fluid step.
  void advance();

  MPI_Comm ranks = MPI_COMM_WORLD;
  SettledCase the_case;
  const Config& config = the_case.config;
  Provenance provenance;
  RunClock clock;
  std::unique_ptr<const Decomposition> pencils;  // nullptr: one rank has all of the grid
  std::vector<std::string> changed_config;       // keys changed since the restart file was written
  SystemState state;
  CoupledStep coupled_step;
  std::int64_t n_grains = 0;           // inside the domain, on all ranks
  std::optional<double> restart_time;  // [s]; empty: a new run

 private:
  void go_on_from(const CheckpointReader& file);
  void check_feed(const std::filesystem::path& file) const;
  void count_grains();
};

}  // namespace barchan
