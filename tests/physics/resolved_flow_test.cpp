// Flow resolved around frozen grains: the same as around bodies, and the grain that is
// perched on a layer.
#include <gtest/gtest.h>

#include <numbers>

#include "src/fluid/solids.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kR = 1e-4;  // [m]
/// A square layer of four on the floor, the fifth in the pocket between them.
const Vec3 kPerched[] = {{1e-4, kR, 1e-4},
                         {3e-4, kR, 1e-4},
                         {1e-4, kR, 3e-4},
                         {3e-4, kR, 3e-4},
                         {2e-4, (1 + std::numbers::sqrt2) * kR, 2e-4}};
constexpr Real kLid = 0.12;  // [m/s]

Config box(int cells) {
  Config c = water_box({4 * cells, 4 * cells, 4 * cells}, {8e-4, 8e-4, 8e-4});
  c.fluid->bottom = c.fluid->top = WallFlow::no_slip;
  c.fluid->top_velocity = kLid;
  c.time.fluid_step = c.time.grain_step = 1.5e-5 * (100.0 / (cells * cells));
  c.coupling.scheme = CouplingScheme::resolved;
  c.grains->frozen = true;
  return c;
}

/// These five, or 20 of them, which have a period of 2 d.
CoupledRun around_grains(int cells, int n) {
  InitialGrains grains;
  for (const Vec3& offset : {Vec3{}, Vec3{4e-4, 0, 0}, Vec3{0, 0, 4e-4}, Vec3{4e-4, 0, 4e-4}})
    for (const Vec3& x : kPerched)
      if (static_cast<int>(grains.size()) < n) add_grain(grains, 2 * kR, x + offset);
  return {box(cells), grains};
}

/// Water at rest in the layer, sheared by the lid above it.
void set_sheared(CoupledRun& run) {
  const Real surface = 2.2 * kR, gap = 8e-4 - surface;
  set_faces(run.state.fluid->u, run.state.fluid->grid, [&](std::size_t axis, Real, Real y, Real) {
    return axis == 0 ? kLid * std::max(0.0, y - surface) / gap : 0;
  });
  run.fill_ghosts();
}

std::vector<BodyLoad> loads_on_grains(const CoupledRun& run) {
  std::vector<BodyLoad> loads(static_cast<std::size_t>(run.state.grains->n));
  const auto id = host_copy(run.state.grains->id);
  for (const NamedForce& force : run.forces()) {
    const auto values = host_copy(force.values);
    for (int g = 0; g < run.state.grains->n; ++g) {
      BodyLoad& load = loads[static_cast<std::size_t>(id(g) - 1)];
      if (force.name == "force_flow") load.force = values(g);
      if (force.name == "torque_flow") load.torque = values(g);
    }
  }
  return loads;
}

TEST(ResolvedFlow, GoesRoundGrainsAsRoundBodies) {
  constexpr int cells = 8, steps = 30;
  Config c = box(cells);
  c.grains.reset();
  for (const Vec3& x : kPerched)
    c.bodies.push_back({.name = "s",
                        .shape = BodyShape::of<shapes::Sphere>(),
                        .centre = {x.x, x.z},
                        .base = x.y - kR,
                        .radius = kR});
  SystemState water;
  water.fluid = make_fluid_state(make_grid(c));
  CoupledRun bodies(c, std::move(water)), grains = around_grains(cells, 5);
  for (CoupledRun* run : {&bodies, &grains}) set_sheared(*run), run->advance(steps);
  const std::vector<BodyLoad> on_grains = loads_on_grains(grains);
  const std::vector<BodyLoad>& on_bodies = bodies.step.fluid_solver()->body_loads();
  const Real force = norm(on_bodies.back().force);
  ASSERT_GT(force, 1e-12);
  ASSERT_EQ(on_bodies.size(), on_grains.size());
  for (std::size_t n = 0; n < on_bodies.size(); ++n) {
    EXPECT_LT(norm(on_grains[n].force - on_bodies[n].force), 1e-6 * force);
    // That on a body is about its lowest point.
    const Vec3 torque = on_bodies[n].torque - cross(Vec3{0, kR, 0}, on_bodies[n].force);
    EXPECT_LT(norm(on_grains[n].torque - torque), 1e-6 * force * kR);
  }
  const ExchangeLedger& ledger = grains.step.exchange();
  Vec3 sum;
  for (const BodyLoad& load : on_grains) sum += load.force;
  EXPECT_LT(norm(ledger.flow_on_grains - grains.step.dt() * sum), 1e-12 * norm(sum));
}

// A code made for this gives torque over force times radius of 0.42 in a period of 3 d, 0.44 in
// this one.
TEST(ResolvedFlow, ThePerchedGrainIsPushedAtItsTop) {
  constexpr int cells = 8, steps = 1500;
  CoupledRun run = around_grains(cells, 20);
  set_sheared(run);
  run.advance(steps);
  const BodyLoad early = loads_on_grains(run).back();
  run.advance(steps / 3);
  const BodyLoad load = loads_on_grains(run).back();
  EXPECT_NEAR(early.force.x / load.force.x, 1, 0.02);  // steady
  const Real lever = -load.torque.z / (load.force.x * kR);
  expect_absolute("torque over force times radius of a perched grain", lever, 0.44, 0.04);
  EXPECT_GT(load.force.y, 0);  // lifted
}

TEST(FrozenGrains, TheNearestIsFoundAsByLookingAtAll) {
  const std::array<double, 3> size{2e-3, 1.5e-3, 1.2e-3};
  InitialGrains random = random_grains(60, {2e-3, 6e-4, 1.2e-3}, 3);
  std::vector<FrozenGrain> all;
  for (std::size_t g = 0; g < random.size(); ++g)
    all.push_back({random.x[g], random.diameter[g] / 2});
  const Real reach = 3e-4;
  const FrozenGrains frozen(all, size[0], size[2], reach);
  Uniform uniform(5);
  int far = 0;
  for (int n = 0; n < 3000; ++n) {
    const Vec3 x{size[0] * uniform(), size[1] * uniform() - 2e-4, size[2] * uniform()};
    Real least = reach;
    for (const FrozenGrain& g : all) {
      Vec3 s = x - g.x;
      s.x -= size[0] * std::round(s.x / size[0]);
      s.z -= size[2] * std::round(s.z / size[2]);
      least = std::min(least, norm(s) - g.r);
    }
    const Bodies::Nearest found = frozen.nearest(x);
    ASSERT_NEAR(found.surface.distance, least, 1e-12);
    ASSERT_EQ(found.body < 0, least == reach);
    far += found.body < 0;
  }
  EXPECT_GT(far, 100);
}

}  // namespace
}  // namespace barchan
