#include "src/run/run_state.hpp"

#include <fmt/ranges.h>

#include "src/base/errors.hpp"
#include "src/config/derived.hpp"
#include "src/config/load.hpp"
#include "src/config/resolved.hpp"
#include "src/fluid/domain.hpp"
#include "src/output/state_file.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/reduce.hpp"
#include "src/run/run_identity.hpp"

namespace barchan {

namespace {

/// Refuses a restart file that does not fit the case.
void check_restart(const Config& config, const CheckpointReader& file) {
  const std::string resolved = file.provenance().config;
  if (resolved.empty()) return;  // not ours: its arrays must speak for themselves
  const auto conflicts = restart_conflicts(config, config_as_written(resolved, file.path()));
  if (conflicts.empty()) return;
  throw InputError(
      fmt::format("cannot restart from {}: it does not fit this case\n  {}\nkeep these keys "
                  "as they were, or start anew",
                  file.path().string(), fmt::join(conflicts, "\n  ")));
}

/// The state a run starts from; a restart brings its own number of grains.
SystemState first_state(const Config& config, const CheckpointReader* restart,
                        const InitialFiles& files, MPI_Comm ranks, const Decomposition* pencils) {
  if (restart == nullptr) return make_initial_state(config, files, ranks, pencils);
  check_restart(config, *restart);
  SystemState state;
  if (config.fluid) state.fluid = make_fluid_state(make_grid(config, pencils));
  if (config.grains) state.grains = grains_in_file(*restart, ranks);
  return state;
}

}  // namespace

RunState::RunState(const Config& the_case, const CheckpointReader* restart,
                   const InitialFiles& files)
    : config(the_case),
      provenance(make_provenance(config)),
      clock{.fluid_step = config.time.fluid_step, .end = fluid_steps(config.time)},
      pencils(make_decomposition(config, ranks)),
      state(as_input([&] { return first_state(config, restart, files, ranks, pencils.get()); })),
      coupled_step(as_input([&] { return CoupledStep(config, state); })) {
  as_input([&] {
    if (restart != nullptr) {
      go_on_from(*restart);
    } else {
      coupled_step.start(state);
    }
  });
  count_grains();
  clock.start = clock.step;
}

void RunState::go_on_from(const CheckpointReader& file) {
  load_state(file, state, coupled_step);
  clock.step = file.integer("step");
  if (clock.step > clock.end) {
    throw InputError(
        fmt::format("cannot restart from {}: its time, {:.6g} s, is beyond time.end = "
                    "{:.6g} s: set a later end, or take an earlier restart file",
                    file.path().string(), file.real("t"), config.time.end));
  }
  restart_time = file.real("t");
  if (std::abs(*restart_time - clock.time()) > 1e-6 * clock.fluid_step) {
    throw InputError(fmt::format("cannot restart from {}: its time {:.6g} s is not that of step {}",
                                 file.path().string(), *restart_time, clock.step));
  }
  const std::string resolved = file.provenance().config;
  if (!resolved.empty())
    changed_config = changed_keys(config, config_as_written(resolved, file.path()));
}

void RunState::advance() {
  coupled_step.advance(state);
  ++clock.step;
  count_grains();
}

void RunState::count_grains() {
  if (state.grains) n_grains = sum_over(ranks, state.grains->n);
}

std::int64_t RunState::n_cells() const {
  if (!state.fluid) return 0;
  const Grid& g = state.fluid->grid;
  return std::int64_t{1} * g.nx_all * g.ny * g.nz_all;
}

}  // namespace barchan
