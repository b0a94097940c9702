// Every way in which grains and flow meet, in a box that the grains do not fill: what is read
// beyond the cells around them is no number (src/parallel/poison.hpp). On 1 and 2 ranks.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/atomic_file.hpp"
#include "src/parallel/poison.hpp"
#include "src/run/simulation.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/coupling_schemes.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/shared_folder.hpp"

namespace barchan {
namespace {

bool is_first() { return rank_of(MPI_COMM_WORLD) == 0; }

/// Surroundings of the grains, by name.
struct Surroundings {
  const char* name;
  void (*set)(Config&);
};
const Surroundings kSurroundings[] = {
    {"periodic", [](Config& c) { c.grains->boundary_x = GrainBoundaryX::periodic; }},
    {"walls",
     [](Config& c) {
       c.grains->boundary_x = GrainBoundaryX::wall;
       c.grains->boundary_z = GrainBoundaryZ::wall;
       c.initial.pour->centre = {0.0393, 0.0007};  // in a corner
     }},
    {"fed",  // one at the outlet leaves while others come in
     [](Config& c) {
       c.fluid->mean_velocity = 0.8;
       c.time.end = 24 * c.time.fluid_step;
       c.grains->feed = FeedConfig{.rate = 8000, .x = 3e-3, .height = 5e-4};
       c.initial.pour->centre = {0.0393, 0.0102};
     }},
    {"post",
     [](Config& c) {
       c.bodies = {{.name = "post",
                    .shape = BodyShape::of<shapes::Cylinder>(),
                    .centre = {0.0212, 0.0101},
                    .radius = 4e-4,
                    .height = 0.004}};
     }},
    {"clumps",
     [](Config& c) {
       c.grains->shape = {.shape = GrainShape::clump, .clump = NamedClump::cube};
       c.grains->boundary_x = GrainBoundaryX::periodic;
       c.coupling.forces.lift = c.coupling.forces.torque = true;
     }},
    {"all forces", [](Config& c) {
       c.fluid->top = WallFlow::free_slip;
       c.coupling.forces.lift = c.coupling.forces.torque = c.coupling.forces.wall_drag = true;
       c.coupling.forces.mixture_viscosity = true;
     }}};

struct Case {
  const test::Scheme& scheme;
  Real smoothing_length;  // [m]
  const Surroundings& around;

  std::string name() const {
    return fmt::format("{}; {} m, {}", scheme.name, smoothing_length, around.name);
  }
};

/// A dozen grains about the middle of a wide channel, where ranks meet; 8 steps of the flow.
Config config_of(const Case& at) {
  Config c = test::coupled_config();
  c.size = {0.040, 0.006, 0.020};
  c.fluid->cells = {40, 14, 20};
  c.grains->sizes = {{2e-4, 12}};
  c.initial.pour->centre = {0.0202, 0.0101};
  c.initial.pour->radius = 6e-4;
  at.scheme.choose(c.coupling);
  c.coupling.smoothing_length = at.smoothing_length;
  c.time.grain_step = 2.5e-5;
  c.grains->material.youngs_modulus = c.grains->wall.youngs_modulus = 5e4;
  c.time.end = 8 * c.time.fluid_step;
  at.around.set(c);
  c.output = {};
  c.output.dune_interval = 0;
  return c;
}

/// Runs to the end of `config`; returns the last restart file.
std::filesystem::path run(const Config& config, const std::filesystem::path& folder,
                          const std::optional<std::filesystem::path>& restart = {},
                          const InitialFiles& files = {}) {
  report::start(report::Shown::problems);
  Simulation simulation(config, {.folder = folder, .restart = restart}, files);
  EXPECT_EQ(simulation.run(), Outcome::done);
  report::stop_log();
  MPI_Barrier(MPI_COMM_WORLD);
  return *simulation.last_restart();
}

void expect_closed(const std::filesystem::path& folder, const Case& at) {
  const auto json = nlohmann::json::parse(read_text(folder / "run.json"));
  const auto& ledger = json.at("ledger");
  EXPECT_GT(std::abs(ledger.at("impulse_given_to_grains_x").get<double>()), 1e-12);
  EXPECT_LT(ledger.at("largest_exchange_mismatch"), 1e-9);
  if (at.scheme.keeps_volume()) {
    EXPECT_LT(ledger.at("largest_volume_mismatch"), 1e-9);
  }
  if (std::string(at.around.name) != "fed") return;
  EXPECT_GT(json.at("grains_left"), 0);
  EXPECT_GT(json.at("grains_fed"), 0);
}

void whole_and_in_two_pieces(const Case& at) {
  SCOPED_TRACE(at.name());
  const test::SharedFolder folder;
  const Config whole = config_of(at);
  Config half = whole;
  half.time.end = whole.time.end / 2;
  const auto at_once = run(whole, folder.path() / "whole");
  const auto middle = run(half, folder.path() / "parts");
  const auto in_parts = run(whole, folder.path() / "parts", middle);
  if (!is_first()) return;
  expect_closed(folder.path() / "whole", at);
  test::expect_same_state(at_once, in_parts);
}

/// Every option with every other one takes two minutes, which is for the night; in the short choice
/// each scheme meets both lengths and most of the surroundings.
std::vector<Case> cases(bool all) {
  std::vector<Case> found;
  int n = 0;
  for (const Surroundings& around : kSurroundings) {
    for (const Real length : {0.0, 6e-4}) {
      for (const test::Scheme& scheme : test::kSchemes) {
        if (all || n++ % 3 == 0) found.push_back({scheme, length, around});
      }
    }
  }
  return found;
}

TEST(PartFilledBox, LedgerClosesAndARestartKeepsTheBits) {
  if (rank_count(MPI_COMM_WORLD) > 2) GTEST_SKIP() << "on 1 and 2 ranks";
  poisons_lent_memory = true;
  const auto all = cases(std::getenv("BARCHAN_ALL_OPTIONS") != nullptr);
  for (const Case& at : all) whole_and_in_two_pieces(at);
  if (is_first()) std::printf("[ measured ] %zu cases, three runs each\n", all.size());
  poisons_lent_memory = false;
}

/// Nine frozen grains, in a corner of a box of fine cells.
Config frozen_config(const std::filesystem::path& table) {
  Config c = test::coupled_config();
  c.size = {3e-3, 1.2e-3, 2e-3};
  c.fluid->cells = {60, 24, 40};
  c.fluid->first_cell_height = 0;
  c.initial = {};
  c.initial.grains = table;
  c.grains->frozen = true;
  c.coupling = {};
  c.coupling.scheme = CouplingScheme::resolved;
  c.time.fluid_step = c.time.grain_step = 2e-5;
  c.time.end = 8 * c.time.fluid_step;
  c.output = {};
  c.output.dune_interval = 0;
  c.output.grains_interval = c.time.end;
  c.output.grain_forces = true;
  return c;
}

/// Forces of the flow at the end on each grain, by id, computed by this rank alone.
std::vector<Vec3> forces_on_one_rank(const Config& config, const std::filesystem::path& table) {
  SystemState state = make_initial_state(config, {.fluid = {}, .grains = table});
  CoupledStep step(config, state);
  step.start(state);
  for (std::int64_t n = 0; n < fluid_steps(config.time); ++n) step.advance(state);
  std::vector<Vec3> forces(static_cast<std::size_t>(state.grains->n));
  const auto id = host_copy(state.grains->id);
  const auto force = host_copy(state.grains->exchange.resolved_force);
  for (int g = 0; g < state.grains->n; ++g) forces[static_cast<std::size_t>(id(g) - 1)] = force(g);
  return forces;
}

void expect_forces_in(const std::filesystem::path& folder, const std::vector<Vec3>& expected) {
  const Hdf5File file(folder / "grains.h5", Hdf5File::Mode::read);
  std::string last;
  for (const std::string& name : file.children("/"))
    if (file.is_group("/" + name) && file.exists("/" + name + "/force_flow")) last = "/" + name;
  ASSERT_FALSE(last.empty());
  const auto id = file.read<std::int64_t>(last + "/id");
  const auto force = file.read<float>(last + "/force_flow");
  ASSERT_EQ(id.size(), expected.size());
  for (std::size_t g = 0; g < id.size(); ++g) {
    const Vec3& wanted = expected[static_cast<std::size_t>(id[g] - 1)];
    EXPECT_NEAR(force[3 * g], wanted.x, 1e-5 * norm(wanted)) << id[g];
    EXPECT_NEAR(force[3 * g + 2], wanted.z, 1e-5 * norm(wanted)) << id[g];
  }
}

TEST(PartFilledBox, FlowIsResolvedAroundFrozenGrains) {
  if (rank_count(MPI_COMM_WORLD) > 2) GTEST_SKIP() << "on 1 and 2 ranks";
  poisons_lent_memory = true;
  const test::SharedFolder folder;
  const auto table = folder.path() / "frozen.csv";
  if (is_first()) {
    std::ofstream file(table);
    file << "id,diameter,x,y,z\n";
    for (int n = 0; n < 9; ++n)
      file << fmt::format("{},2e-4,{},1e-4,{}\n", n + 1, 2e-4 * (n % 3), 2e-4 + 2.1e-4 * (n / 3));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const Config whole = frozen_config(table);
  Config half = whole;
  half.time.end = whole.time.end / 2;
  const auto at_once = run(whole, folder.path() / "whole", {}, {.fluid = {}, .grains = table});
  const auto middle = run(half, folder.path() / "parts", {}, {.fluid = {}, .grains = table});
  const auto in_parts = run(whole, folder.path() / "parts", middle);
  poisons_lent_memory = false;
  if (!is_first()) return;
  test::expect_same_state(at_once, in_parts);
  expect_forces_in(folder.path() / "whole", forces_on_one_rank(whole, table));
  const auto json = nlohmann::json::parse(read_text(folder.path() / "whole/run.json"));
  // These forces act from the first step in a flow of 0.24 m/s.
  const double impulse = json.at("ledger").at("impulse_of_flow_on_grains_x");
  std::printf("[ measured ] impulse on frozen grains: %.17g N s\n", impulse);
  EXPECT_GT(impulse, 1e-12);
}

}  // namespace
}  // namespace barchan
