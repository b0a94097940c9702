#include "src/run/run_state.hpp"

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "src/base/errors.hpp"
#include "src/case/derived.hpp"
#include "src/case/load.hpp"
#include "src/case/resolved.hpp"
#include "src/fluid/domain.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/grain_feed.hpp"
#include "src/initial/overlaps.hpp"
#include "src/parallel/reduce.hpp"
#include "src/restart/grain_state_file.hpp"
#include "src/restart/state_file.hpp"
#include "src/run/run_folder.hpp"

namespace barchan {

namespace {

/// Keys that changed since the restart file was written. Refuses a file that does not fit the case.
std::vector<std::string> changes_since(const CheckpointReader& file, const Config& config) {
  const std::string resolved = file.provenance().config;
  if (resolved.empty()) return {};  // a foreign file: its arrays must speak for themselves
  const Config written = config_as_written(resolved, file.path());
  const auto conflicts = restart_conflicts(config, written);
  if (conflicts.empty()) return changed_keys(config, written);
  throw InputError(
      fmt::format("cannot restart from {}: it does not fit this case\n  {}\nkeep these keys "
                  "as they were, or start anew",
                  file.path().string(), fmt::join(conflicts, "\n  ")));
}

/// Widths of the grains that a feed may bring in. All ranks call it together.
Widths widths_to_feed(const GrainConfig& config, const GrainState& grains) {
  if (!has_clumps(config)) return {.least = 2 * grains.r_min, .most = 2 * grains.r_max};
  std::vector<SizeClass> sizes;
  for (const GrainBody& body : grains.feed.next_id > 0 ? grains.feed.bodies : bodies_of(grains))
    sizes.push_back({.diameter = 2 * body.r, .kind = static_cast<int>(body.kind)});
  return sizes.empty() ? Widths() : widths_of(config, sizes);
}

/// State that a run starts from; a restart brings its own number of grains.
SystemState first_state(const SettledCase& the_case, const CheckpointReader* restart,
                        const InitialFiles& files, MPI_Comm ranks, const Decomposition* pencils) {
  if (restart == nullptr) return make_initial_state(the_case, files, ranks, pencils);
  SystemState state;
  if (the_case.config.fluid) state.fluid = make_fluid_state(make_grid(the_case.fluid(), pencils));
  if (the_case.config.grains) state.grains = grains_in_file(*restart, ranks);
  return state;
}

}  // namespace

RunState::RunState(const SettledCase& settled, const CheckpointReader* restart,
                   const InitialFiles& files)
    : the_case(settled),
      provenance(make_provenance(config)),
      clock{.fluid_step = config.time.fluid_step, .end = fluid_steps(config.time)},
      pencils(make_decomposition(config.fluid, ranks)),
      changed_config(restart ? changes_since(*restart, config) : std::vector<std::string>()),
      state(first_state(the_case, restart, files, ranks, pencils.get())),
      coupled_step(the_case.coupled, state) {
  provenance.inputs = restart != nullptr ? restart->provenance().inputs : files.record;
  if (restart != nullptr) {
    go_on_from(*restart);
  } else {
    coupled_step.start(state);
  }
  count_grains();
  if (restart != nullptr && config.grains && config.grains->feed) check_feed(restart->path());
  clock.start = clock.step;
}

RunState::RunState(const SettledCase& settled, std::unique_ptr<const Decomposition> the_pencils,
                   SystemState first)
    : the_case(settled),
      provenance(make_provenance(config)),
      clock{.fluid_step = config.time.fluid_step, .end = fluid_steps(config.time)},
      pencils(std::move(the_pencils)),
      state(std::move(first)),
      coupled_step(the_case.coupled, state) {
  coupled_step.start(state);
  count_grains();
}

void RunState::go_on_from(const CheckpointReader& file) {
  load_state(file, state, coupled_step.neighbor_list());
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
}

/// Checks the feed, which may be new since the file was written.
void RunState::check_feed(const std::filesystem::path& file) const {
  const GrainState& grains = *state.grains;
  check_free_ids(config, last_id(grains), file.string());
  check_feed_places(the_case.grains(), widths_to_feed(*config.grains, grains));
  const bool no_body = grains.feed.next_id == 0 ? n_grains == 0 : grains.feed.bodies.empty();
  if (no_body && config.grains->feed->amount == FeedAmount::given)
    throw InputError(
        file.string() +
        ": grains.feed.amount = \"given\": no grains are left whose sizes it could take");
}

void RunState::advance() {
  coupled_step.advance(state);
  ++clock.step;
  count_grains();
}

void RunState::count_grains() {
  if (state.grains) n_grains = sum_over(ranks, grain_count(*state.grains));
}

}  // namespace barchan
