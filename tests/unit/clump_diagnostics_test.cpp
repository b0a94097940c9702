// Diagnostics of cases with clumps: a clump is one grain, the sphere of its volume.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "kernels/grains/sphere.hpp"
#include "src/diagnostics/bed_load.hpp"
#include "src/diagnostics/gathered_grains.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/overlaps.hpp"
#include "src/initial/window.hpp"
#include "tests/support/clumps.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using namespace test;

/// Grains of two sizes on a lattice in a part of a box of 20 x 10 x 10 mm, each with its speed.
InitialGrains loose_grains(int n) {
  Uniform uniform(6);
  InitialGrains grains;
  for (int g = 0; g < n; ++g)
    add_grain(grains, g % 2 == 0 ? 2e-4 : 3e-4,
              {5e-4 + 7e-4 * (g % 8), 5e-4 + 7e-4 * (g / 64), 5e-4 + 7e-4 * (g / 8 % 8)},
              {0.1 * uniform(), 0.1 * uniform(), 0}, {300 * uniform(), 0, 100});
  return grains;
}

Config loose_case(const ShapeConfig& shape) {
  Config c = flow_config({8, 10, 4}, {0.02, 0.01, 0.01}, 0);
  c.grains.emplace();
  c.grains->gravity = {0, 0, 0};
  c.grains->shape = shape;
  return c;
}

/// Both have the same volume, mass and velocity at the same heights.
TEST(ClumpDiagnostics, BedLoadIsThatOfTheSpheresOfTheirVolume) {
  const InitialGrains grains = loose_grains(200);
  const Config c = loose_case({.shape = GrainShape::clump, .clump = NamedClump::sand});
  const ClumpBench clumps(c, grains);
  const GrainState spheres = make_grain_state(grains, 2500);
  const Grid grid = make_grid(c);
  const FluidState fluid = make_fluid_state(grid);
  const auto table = [&](const GrainState& state) {
    BedLoad load({.fluid_density = 1000, .viscosity = 1e-6, .gravity = {0, -9.81, 0}}, grid);
    load.sample(fluid, state, 1);
    return load.table();
  };
  const auto a = table(clumps.state), b = table(spheres);
  ASSERT_EQ(a.size(), 160u);  // four to a mean diameter
  ASSERT_EQ(b.size(), a.size());
  double q = 0;
  for (std::size_t g = 0; g < grains.size(); ++g)
    q += sphere_volume(grains.diameter[g] / 2) * grains.u[g].x / (0.02 * 0.01);
  EXPECT_NEAR(a[0].q, q, 1e-12 * q);
  EXPECT_NEAR(a[0].d, 2.5e-4, 1e-15);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(a[k].solid_fraction, b[k].solid_fraction, 1e-12);
    EXPECT_NEAR(a[k].flux_density, b[k].flux_density, 1e-13);
    EXPECT_NEAR(a[k].particle_pressure, b[k].particle_pressure, 1e-9 * b[0].particle_pressure);
    EXPECT_NEAR(a[k].load, b[k].load, 1e-9 * b[k].load);
    EXPECT_NEAR(a[k].load_velocity, b[k].load_velocity, 1e-9 * b[k].load_velocity);
  }
  EXPECT_GT(b[0].particle_pressure, 0.1);
}

TEST(ClumpDiagnostics, DunesAreMadeOfWholeGrains) {
  InitialGrains grains = loose_grains(30);
  grains.heap_names = {"a", "b"};
  for (int g = 0; g < 30; ++g) grains.heap.push_back(g < 10 ? 0 : 1);
  const ClumpBench bench(loose_case({.shape = GrainShape::clump, .clump = NamedClump::cube}),
                         grains);
  ASSERT_EQ(bench.state.n, 240);
  double volume = 0, flow = 0;
  std::map<Real, int> of_heap;
  const std::vector<GrainSample> all = gathered_grains(bench.state);
  ASSERT_EQ(all.size(), 30u);
  for (const GrainSample& one : all) {
    volume += sphere_volume(one.d / 2);
    flow += sphere_volume(one.d / 2) * one.u_x;
    ++of_heap[one.heap];
  }
  double volume_of_all = 0, flow_of_all = 0;
  for (std::size_t g = 0; g < 30; ++g) {
    const double of_one = sphere_volume(grains.diameter[g] / 2);
    volume_of_all += of_one, flow_of_all += of_one * grains.u[g].x;
  }
  EXPECT_NEAR(volume / volume_of_all, 1, 1e-13);
  EXPECT_NEAR(flow / flow_of_all, 1, 1e-13);
  EXPECT_EQ(of_heap, (std::map<Real, int>{{0, 10}, {1, 20}}));
}

/// Momenta of whole grains by number.
std::map<std::int64_t, Vec3> momenta(const GrainState& grains) {
  const GrainState whole = whole_grains(grains);
  const auto motion = host_copy(whole.clump);
  const auto id = host_copy(whole.id);
  std::map<std::int64_t, Vec3> all;
  for (int g = 0; g < whole.n; ++g) all[id(g)] = motion(g).m * motion(g).u;
  return all;
}

/// The mean force on a clump over a step is its change of momentum, in the order of whole grains:
/// dimers that sink in still water, of which some meet the floor.
TEST(ClumpDiagnostics, MeanForceIsTheChangeOfMomentumOfTheClump) {
  Config c = still_water({0.02, 0.01, 0.01});
  c.grains->gravity = {0, -9.81, 0};
  c.grains->shape = {.shape = GrainShape::clump, .clump = NamedClump::dimer};
  InitialGrains grains = loose_grains(40);
  for (Vec3& x : grains.x) x.y = 2.5e-4;
  for (Vec3& u : grains.u) u.y = -0.1;
  SystemState state;
  state.grains = make_grain_state(as_spheres(grains, *c.grains, 1), 2500);
  CoupledRun run(c, std::move(state));
  run.advance(4);
  const auto before = momenta(*run.state.grains);
  run.advance(1);
  const auto after = momenta(*run.state.grains);
  const auto force = host_copy(mean_resultant_force(*run.state.grains, run.step.dt()));
  const GrainState whole = whole_grains(*run.state.grains);
  const auto contacts = host_copy(whole.contact_force);
  const auto id = host_copy(whole.id);
  ASSERT_EQ(whole.n, 40);
  int touching = 0;
  for (int g = 0; g < 40; ++g) {
    const Vec3 change = (1 / run.step.dt()) * (after.at(id(g)) - before.at(id(g)));
    EXPECT_NEAR(norm(force(g) - change), 0, 1e-9 * norm(change)) << g;
    touching += norm(contacts(g)) > 0 ? 1 : 0;
  }
  EXPECT_GT(touching, 0);
  EXPECT_LT(touching, 40);
}

TEST(ClumpDiagnostics, MeanDiameterOfDragLawsIsThatOfWholeGrains) {
  InitialGrains grains = loose_grains(31);
  const Config c = loose_case({.shape = GrainShape::clump, .clump = NamedClump::cube});
  const GrainState clumps = make_grain_state(as_spheres(grains, *c.grains, 1), 2500),
                   spheres = make_grain_state(grains, 2500);
  EXPECT_DOUBLE_EQ(clumps.sauter_diameter, spheres.sauter_diameter);
  EXPECT_NEAR(clumps.r_max, spheres.r_max / 2, 1e-9 * spheres.r_max) << "of a sphere of eight";
}

// A layer of grains on squares so wide that rods do not meet, however they are turned.
constexpr double kD = 5e-4, kRod = 2.52 * kD, kPitch = 1.3 * kRod;  // [m]

InitialGrains layer() {
  InitialGrains grains;
  for (double x = kPitch / 2; x < 0.02; x += kPitch)
    for (double z = kPitch / 2; z < 0.02; z += kPitch) add_grain(grains, kD, {x, 1e-3, z});
  return grains;
}

/// Case that begins with five columns and rows of it; `gap`: between the first and the last of them
/// across the sides [m].
Config window_case(double gap_x, double gap_z) {
  Config c = grain_config();
  c.size = {4 * kPitch + gap_x, 4e-3, 4 * kPitch + gap_z};
  c.grains->boundary_x = GrainBoundaryX::periodic;
  c.initial.window = {2.3 * kPitch, 3.3 * kPitch};
  c.grains->shape = {.shape = GrainShape::clump, .spheres = rod()};
  return c;
}

/// Rods that lie almost along x meet across sides 1.6 d apart along x, and do not 0.9 d apart along
/// z: the spheres of their volume would do the opposite.
TEST(ClumpWindow, OfClumpsThatOverlapWhereSidesMeetOneGoes) {
  Config c = window_case(1.6 * kD, 0.9 * kD);
  const PeriodicBox box{c.size[0], c.size[2]};
  InitialGrains whole = layer();
  whole.q.assign(whole.size(), rotation_about({0, 1, 0}, 0.1));
  InitialGrains rods = whole;
  cut_to_window(c, {}, whole);
  cut_to_window(c, box, rods);
  EXPECT_EQ(whole.size(), 25u);
  EXPECT_EQ(rods.size(), 20u);
  ASSERT_EQ(rods.q.size(), 20u);
  std::set<Real> columns, rows;
  for (const Vec3& x : rods.x) columns.insert(x.x), rows.insert(x.z);
  EXPECT_EQ(columns.size(), 4u);
  EXPECT_EQ(rows.size(), 5u);
  c.grains->shape = {};
  InitialGrains spheres = layer();
  cut_to_window(c, box, spheres);
  columns.clear(), rows.clear();
  for (const Vec3& x : spheres.x) columns.insert(x.x), rows.insert(x.z);
  EXPECT_EQ(columns.size(), 5u);
  EXPECT_EQ(rows.size(), 4u);
}

/// Half of a rod lies past the side, where it meets a rod whose spheres are farther inside than
/// they are wide.
TEST(ClumpWindow, OfClumpsThatOverlapFarPastASideOneGoes) {
  for (const bool along_x : {true, false}) {
    Config c = window_case(kPitch, kPitch);
    const PeriodicBox box{c.size[0], c.size[2]};
    c.initial.window = {0, 0};
    const Real y = 1e-3, mid = 2 * kPitch;
    const auto at = [&](Real along) { return along_x ? Vec3{along, y, mid} : Vec3{mid, y, along}; };
    InitialGrains rods;
    add_grain(rods, kD, at((along_x ? box.lx : box.lz) - 0.01 * kD));
    add_grain(rods, kD, at(1.9 * kD));
    const Quaternion q = rotation_about({0, 1, 0}, along_x ? 0 : std::numbers::pi_v<Real> / 2);
    rods.q.assign(2, q);
    EXPECT_TRUE(contains(
        message_of([&] { check_overlaps(spheres_at_start(rods, c), box, 0.1, "rods.csv"); }),
        "grains 1 and 2 overlap"));
    cut_to_window(c, box, rods);
    EXPECT_EQ(rods.size(), 1u) << along_x;
  }
}

TEST(ClumpWindow, ClumpsThatReachIntoAWallGo) {
  Config c = window_case(kPitch, kPitch);
  InitialGrains open = layer(), walled = layer();
  cut_to_window(c, {}, open);
  c.grains->boundary_x = GrainBoundaryX::wall;
  c.grains->boundary_z = GrainBoundaryZ::wall;
  cut_to_window(c, {}, walled);
  const InitialGrains spheres = spheres_at_start(open, c);
  std::set<std::int64_t> through;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    const double r = 0.98 * spheres.diameter[s] / 2;
    const Vec3& x = spheres.x[s];
    if (x.x < r || x.x > c.size[0] - r || x.z < r || x.z > c.size[2] - r)
      through.insert(clump_of_id(spheres.id[s]));
  }
  EXPECT_GT(through.size(), 3u);
  EXPECT_LT(through.size(), 16u) << "those inside stay";
  EXPECT_EQ(walled.size(), open.size() - through.size());
  for (const std::int64_t id : walled.id) EXPECT_FALSE(through.contains(id)) << id;
}

TEST(ClumpDiagnostics, ClumpsInABodyCountOnce) {
  Config c = grain_config();
  c.grains->shape = {.shape = GrainShape::clump, .clump = NamedClump::cube};
  c.bodies = {{.name = "post",
               .shape = BodyShape::of<shapes::Cylinder>(),
               .centre = {5e-3, 5e-3},
               .radius = 2e-3,
               .height = 4e-3}};
  InitialGrains grains;
  for (const Real x : {4e-3, 5e-3, 6e-3, 8e-3}) add_grain(grains, kD, {x, 2e-3, 5e-3});
  const auto said = message_of([&] { check_outside_bodies(spheres_at_start(grains, c), c, "it"); });
  EXPECT_TRUE(said.starts_with("it: 3 grains lie in body \"post\"")) << said;
}

}  // namespace
}  // namespace barchan
