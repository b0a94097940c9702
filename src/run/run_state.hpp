// A run in memory: the case, its state, what advances it, and how far it has come.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/config/config.hpp"
#include "src/coupling/coupled_step.hpp"
#include "src/io/checkpoint.hpp"
#include "src/parallel/decomposition.hpp"
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
  /// Starts a new run, or goes on from a restart file. Reads and checks all that it starts from,
  /// and writes nothing. Throws InputError when that cannot be used. All ranks together.
  RunState(const Config& config, const CheckpointReader* restart, const InitialFiles& files);

  /// One fluid step.
  void advance();
  std::int64_t n_cells() const;  // of all ranks; 0 without a flow

  MPI_Comm ranks = MPI_COMM_WORLD;
  Config config;
  Provenance provenance;
  RunClock clock;
  std::unique_ptr<const Decomposition> pencils;  // none: one rank has all of the grid
  SystemState state;
  CoupledStep coupled_step;
  std::int64_t n_grains = 0;                // inside, of all ranks
  std::optional<double> restart_time;       // [s]; none: a new run
  std::vector<std::string> changed_config;  // keys, since the restart file was written

 private:
  void go_on_from(const CheckpointReader& file);
  void count_grains();
};

}  // namespace barchan
