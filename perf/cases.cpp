#include "perf/cases.hpp"

#include <cmath>

#include "perf/events.hpp"
#include "perf/heaps.hpp"
#include "perf/options.hpp"
#include "src/case/load.hpp"
#include "src/fluid/domain.hpp"
#include "src/initial/grain_files.hpp"
#include "src/initial/initial_state.hpp"
#include "src/restart/grain_state_file.hpp"
#include "src/restart/state_file.hpp"

namespace barchan {

namespace {

constexpr std::array<double, 3> kPaperChannel{0.4, 0.025, 0.1};  // [m]

/// Shrinks a case to a box that takes milliseconds, with the same physics.
void shrink(Config& c) {
  c.size = {0.04, 0.0125, 0.02};
  if (c.fluid) c.fluid->cells = {32, 12, 16}, c.fluid->first_cell_height = 0;
}

void add_grains(Config& c) {
  c.grains.emplace();
  c.grains->wall = c.grains->material;
}

CaseSpec sized(CaseSpec spec) {
  if (options().tiny) shrink(spec.config);
  return spec;
}

}  // namespace

CaseSpec grains_alone(const std::string& name, const std::string& heap, double rolling_friction) {
  CaseSpec spec{.name = name, .config = {}, .heap = heap};
  Config& c = spec.config;
  c.size = kPaperChannel;
  add_grains(c);
  GrainConfig& grains = *c.grains;
  grains.material.rolling_friction = grains.wall.rolling_friction = rolling_friction;
  grains.gravity = {0, -5.886, 0};
  grains.skin = 2e-5;
  return sized(spec);
}

CaseSpec ten_heaps() {
  CaseSpec spec = grains_alone("dem/heaps_1m", "heap_100k", 0);
  spec.heaps_in_a_row = 10;
  return spec;
}

CaseSpec channel_flow(const std::string& name, int mesh) {
  CaseSpec spec{.name = name, .config = {}, .untimed_steps = 20};
  Config& c = spec.config;
  c.size = kPaperChannel;
  c.fluid.emplace();
  constexpr double first_cell_height[] = {2.625e-4, 1.75e-4, 1.25e-4};  // as in configs/paper
  c.fluid->cells = {250, 15 * (mesh + 1), 63};
  c.fluid->first_cell_height = first_cell_height[mesh - 1];
  c.fluid->mean_velocity = 0.28;
  c.initial.fluid = "turbulent";
  return sized(spec);
}

CaseSpec heap_in_channel(const std::string& name, const std::string& heap, int mesh) {
  CaseSpec spec = channel_flow(name, mesh);
  spec.heap = heap;
  spec.untimed_steps = 5;
  add_grains(spec.config);
  return spec;
}

CaseSpec shipped_10k(const std::string& name) {
  CaseSpec spec{.name = name,
                .config = load_config(BARCHAN_SOURCE_DIR "/configs/barchan-10k.toml"),
                .heap = "heap_10k",
                .untimed_steps = 5};
  spec.config.initial.fluid = "turbulent";
  return sized(spec);
}

CaseSpec moving_dune(const std::string& name, const std::filesystem::path& restart) {
  const CheckpointReader file(restart, MPI_COMM_SELF);
  return {.name = name,
          .config = config_as_written(file.provenance().config, restart),
          .dune = restart,
          .untimed_steps = 5};
}

CaseSpec moving_grains(const std::string& name, const std::filesystem::path& restart) {
  CaseSpec spec = moving_dune(name, restart);
  Config& c = spec.config;
  const double buoyancy = c.fluid->density / c.grains->density;
  for (double& g : c.grains->gravity) g *= 1 - buoyancy;
  c.fluid.reset();
  spec.untimed_steps = 2;
  return spec;
}

namespace {

/// Lets the flow find its way around the grains before they may move: a flow that does not know of
/// the heap would blow it apart in its first steps, and lists would be rebuilt all the time.
void flow_around_held_grains(Config config, SystemState& state) {
  constexpr int n_steps = 30;
  config.grains->frozen = true;
  CoupledStep step(config, state);
  step.start(state);
  for (int n = 0; n < n_steps; ++n) step.advance(state);
}

/// Copies of the grains, one box of length `lx` after the other.
void repeat_along_x(InitialGrains& grains, int copies, double lx) {
  const std::size_t n = grains.size();
  for (int copy = 1; copy < copies; ++copy) {
    for (std::size_t g = 0; g < n; ++g) {
      grains.id.push_back(grains.id[g] + static_cast<std::int64_t>(n) * copy);
      grains.diameter.push_back(grains.diameter[g]);
      grains.x.push_back(grains.x[g] + Vec3{copy * lx, 0, 0});
      grains.u.push_back(grains.u[g]);
      grains.omega.push_back(grains.omega[g]);
    }
  }
}

}  // namespace

RunningCase::RunningCase(const CaseSpec& the_spec) : spec(the_spec) {
  const Config& config = spec.config;
  if (!spec.dune.empty() && config.fluid) {
    const CheckpointReader file(spec.dune, MPI_COMM_SELF);
    grains_source = spec.dune.string();
    state.fluid = make_fluid_state(make_grid(config));
    state.grains = grains_in_file(file, MPI_COMM_SELF);
    step = std::make_unique<CoupledStep>(config, state);
    load_state(file, state, step->neighbor_list());
  } else {
    Config flow_alone = config;
    flow_alone.grains.reset();
    state = make_initial_state(flow_alone, {});
    if (config.grains) put_grains();
    if (state.fluid && state.grains) flow_around_held_grains(config, state);
    step = std::make_unique<CoupledStep>(config, state);
    step->start(state);
  }
  // The list and the rows have two sets of memory, taken in the first two rebuilds.
  if (state.grains) step->neighbor_list()->rebuild(*state.grains, true);
  for (int n = 0; n < spec.untimed_steps; ++n) advance();
  bytes_ = array_bytes();
}

/// Adds the grains of a heap, or of a dune.
void RunningCase::put_grains() {
  Config& config = spec.config;
  Heap heap = spec.dune.empty() ? settled_heap(spec.heap)
                                : Heap{read_grains(spec.dune), spec.dune.string()};
  grains_source = heap.source;
  if (spec.dune.empty() && config.size != kPaperChannel) move_into(heap.grains, config.size);
  repeat_along_x(heap.grains, spec.heaps_in_a_row, config.size[0]);
  config.size[0] *= spec.heaps_in_a_row;
  state.grains = make_grain_state(heap.grains, config.grains->density);
}

void RunningCase::advance() {
  // A rebuild that keeps the contact history, as after the loss of a grain.
  if (spec.rebuild_each_step) step->neighbor_list()->rebuild(*state.grains, true);
  step->advance(state);
}

double RunningCase::cells() const {
  if (!state.fluid) return 0;
  const Grid& g = state.fluid->grid;
  return static_cast<double>(g.nx) * g.ny * g.nz;
}

namespace {

std::unique_ptr<RunningCase>& last_case() {
  static std::unique_ptr<RunningCase> the_case;
  return the_case;
}

}  // namespace

RunningCase& running_case(const CaseSpec& spec) {
  std::unique_ptr<RunningCase>& last = last_case();
  if (last && last->spec.name == spec.name) return *last;
  last.reset();  // before the next takes memory
  last = std::make_unique<RunningCase>(spec);
  return *last;
}

void drop_running_case() { last_case().reset(); }

}  // namespace barchan
