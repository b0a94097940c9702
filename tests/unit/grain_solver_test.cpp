// Motion of grains against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/coupling/frozen_grains.hpp"
#include "kernels/grains/grain_sums.hpp"
#include "kernels/grains/half_kick.hpp"
#include "kernels/grains/sphere.hpp"
#include "tests/support/grain_bench.hpp"
#include "tests/support/launch_counter.hpp"

namespace barchan {
namespace {

using test::add_grain;
using test::grain_config;
using test::GrainBench;
using test::rows_by_id;
using test::set_weight;

TEST(GrainSolver, FreeFallIsExact) {
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 0.009, 0.005}, {0.02, 0, -0.01});
  GrainBench c(grain_config(), g);
  set_weight(c.state, {0, -9.81, 0});
  c.advance(1000, 1e-5);
  EXPECT_EQ(c.solver.contacts(c.state).n_contacts, 0);
  EXPECT_EQ(c.solver.contacts(c.state).max_overlap, 0);
  const auto row = rows_by_id(c.state)[1];
  // The force of the first half kick was still zero: u and x lag by half a step of g.
  EXPECT_NEAR(row.u.y, -9.81 * 0.01, 1e-9);
  EXPECT_NEAR(row.x.y, 0.009 - 0.5 * 9.81 * 1e-4, 1e-9);
  EXPECT_NEAR(row.x.x, 0.0052, 1e-15);
  EXPECT_NEAR(row.x.z, 0.0049, 1e-15);
}

TEST(GrainSolver, CollisionConservesMomentumAndDeliversRestitution) {
  for (const Real e : {0.1, 0.9}) {
    Config config = grain_config();
    config.grains->material.restitution = e;
    InitialGrains g;
    add_grain(g, 2e-4, {0.005, 0.005, 0.005}, {0.05, 0, 0});
    add_grain(g, 2.5e-4, {0.005 + 2.26e-4, 0.005, 0.005}, {-0.05, 0, 0});
    GrainBench c(config, g);
    c.advance(4000, 5e-8);
    const auto rows = rows_by_id(c.state);
    EXPECT_NEAR((rows[2].u.x - rows[1].u.x) / 0.1, e, 1e-3);
    const Real m1 = 1, m2 = std::pow(1.25, 3);
    EXPECT_NEAR(m1 * rows[1].u.x + m2 * rows[2].u.x, (m1 - m2) * 0.05, 1e-13);
  }
}

TEST(GrainSolver, ObliqueCollisionConservesAngularMomentum) {
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 0.005, 0.005}, {0.05, 0.03, 0.01}, {50, -20, 10});
  add_grain(g, 2e-4, {0.0052005, 0.00501, 0.00499}, {-0.05, 0, 0}, {0, 30, -70});
  GrainBench c(grain_config(), g);
  const Real m = sphere_volume(1e-4) * 2500, inertia = sphere_inertia(m, 1e-4);
  const auto angular = [&] {
    Vec3 sum;
    const auto rows = rows_by_id(c.state);
    for (int p : {1, 2}) {
      sum += m * cross(rows[p].x - Vec3{0.005, 0.005, 0.005}, rows[p].u) + inertia * rows[p].omega;
    }
    return sum;
  };
  const Vec3 before = angular();
  c.advance(2000, 5e-8);
  const Real scale = m * 1e-4 * 0.05;
  EXPECT_LT(norm(angular() - before), 2e-6 * scale);
  EXPECT_GT(norm(rows_by_id(c.state)[1].omega - Vec3{50, -20, 10}), 1) << "they did collide";
}

TEST(GrainSolver, AWallReturnsByItsOwnRestitution) {
  Config config = grain_config();
  config.grains->material.restitution = 0.1;
  config.grains->wall.restitution = 0.8;
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 1.01e-4, 0.005}, {0, -0.05, 0});
  GrainBench c(config, g);
  c.advance(4000, 5e-8);
  EXPECT_NEAR(c.grain(1).u.y / 0.05, 0.8, 1e-3);
}

TEST(GrainSolver, KineticEnergyIsOfTranslationAndRotation) {
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 0.005, 0.005}, {0.3, 0, 0.4}, {0, 1000, 0});
  const GrainBench c(grain_config(), g);
  Real energy = 0;
  Kokkos::parallel_reduce("test: energy", c.state.n, GrainKineticEnergy{c.state.kin}, energy);
  const Real m = 2500 * sphere_volume(1e-4);
  EXPECT_NEAR(energy / (m * (0.25 / 2 + 0.4 * 1e-8 * 1e6 / 2)), 1, 1e-14);
}

// --- The list of neighbours in time.

/// Two grains that fly at each other from just beyond the reach of the first list.
GrainBench head_on() {
  Config config = grain_config();
  config.grains->skin = 2e-5;
  const Real apart = 2e-4 + 1.51 * config.grains->skin;  // alike fast: half as wide again
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 0.005, 0.005}, {0.5, 0, 0});
  add_grain(g, 2e-4, {0.005 + apart, 0.005, 0.005}, {-0.5, 0, 0});
  return {config, g};
}

TEST(GrainSolver, GrainsFromBeyondTheSkinMeetAtTheirFirstTouch) {
  const Real dt = 5e-8, way = 2 * 0.5 * dt;  // towards each other in a step
  GrainBench c = head_on();
  EXPECT_EQ(c.state.list.n_pairs, 0);
  while (c.solver.contacts(c.state).n_contacts == 0 && c.grain(1).u.x == 0.5) c.advance(1, dt);
  const Real overlap = 2e-4 * c.solver.contacts(c.state).max_overlap;
  EXPECT_GT(overlap, 0);
  EXPECT_LE(overlap, way * (1 + 1e-9));

  GrainBench at_once = head_on(), always = head_on();
  at_once.advance(1000, dt);
  for (int n = 0; n < 1000; ++n) {
    always.solver.list().rebuild(always.state, false);
    always.advance(1, dt);
  }
  EXPECT_LT(at_once.grain(1).u.x, 0) << "they have met";
  EXPECT_EQ(at_once.grain(1).u.x, always.grain(1).u.x);
}

TEST(GrainSolver, DragRelaxesToTheFluid) {
  InitialGrains g;
  add_grain(g, 2e-4, {0.002, 0.005, 0.005});
  GrainBench c(grain_config(), g);
  const Real m = sphere_volume(1e-4) * 2500, beta = m / 5e-3, added = 0.2 * m;
  add_fluid(c.state);
  Kokkos::deep_copy(c.state.fluid.beta, beta);
  Kokkos::deep_copy(c.state.fluid.added_mass, added);
  Kokkos::deep_copy(c.state.fluid.u_f, Vec3{0.1, 0, 0.02});
  c.advance(2000, 2.5e-6);
  const Real expected = 0.1 * (1 - std::exp(-5e-3 / (1.2 * 5e-3)));
  EXPECT_NEAR(rows_by_id(c.state)[1].u.x, expected, 1e-3 * expected);
  // The impulse of drag and added mass is what moved the grain.
  const auto impulse = host_copy(c.state.fluid.impulse);
  EXPECT_NEAR(impulse(0).x / (m * rows_by_id(c.state)[1].u.x), 1, 1e-12);
}

/// A grain and its share of fluid, one pulled by its weight, the other by what else acts on it:
/// their slip goes to its end exponentially, and both together keep their momentum.
TEST(GrainSolver, AGrainCarriesItsShareOfFluid) {
  Config config = grain_config();
  config.grains->gravity = {0, -9.81, 0};
  InitialGrains g;
  add_grain(g, 2e-4, {0.002, 0.005, 0.005}, {0, 0, 0.03});
  GrainBench c(config, g);
  const Real m = sphere_volume(1e-4) * 2500, share = 0.4 * m, added = 0.2 * m, beta = m / 2e-3;
  const Real weight = 9.81 * m, a = -3.0, u_f = 0.05, time = 5e-3;
  add_fluid(c.state);
  Kokkos::deep_copy(c.state.fluid.beta, beta);
  Kokkos::deep_copy(c.state.fluid.added_mass, added);
  Kokkos::deep_copy(c.state.fluid.inv_fluid_mass, 1 / share);
  Kokkos::deep_copy(c.state.fluid.acceleration, Vec3{0, a, 0});
  Kokkos::deep_copy(c.state.fluid.explicit_force, Vec3{0, -weight, 0});
  Kokkos::deep_copy(c.state.fluid.u_f, Vec3{u_f, 0, 0});
  c.advance(2000, 2.5e-6);
  const Vec3 u = rows_by_id(c.state)[1].u, impulse = host_copy(c.state.fluid.impulse)(0);
  const Vec3 u_f_now = Vec3{u_f, time * a, 0} - (1 / share) * impulse;
  const Real reduced = 1 / (1 / m + 1 / share);  // d(slip)/dt (reduced + added) = ... - beta slip
  const Real kept = std::exp(-time * beta / (reduced + added));
  const Real end = reduced * (a + 9.81) / beta;
  EXPECT_NEAR(u_f_now.x - u.x, u_f * kept, 1e-3 * u_f);
  EXPECT_NEAR(u_f_now.y - u.y, end * (1 - kept), 1e-3 * end);
  EXPECT_NEAR(u_f_now.z - u.z, -0.03 * kept, 1e-3 * 0.03);
  const Vec3 momentum = m * u + share * u_f_now;
  const Vec3 expected{share * u_f, time * (share * a - weight), m * 0.03};
  EXPECT_LT(norm(momentum - expected), 1e-12 * norm(expected));
}

/// A grain that cannot move brakes its share of fluid in a step as one of infinite mass.
TEST(GrainSolver, HeldGrainsBrakeTheirShareOfFluid) {
  InitialGrains g;
  add_grain(g, 2e-4, {0.002, 0.005, 0.005});
  GrainBench c(grain_config(), g);
  const Real share = 4e-9, added = 2e-9, beta = 3e-5, dt = 5e-4;
  const Vec3 u_f{0.05, 0, 0.01}, acceleration{-3, 2, 0};
  add_fluid(c.state);
  Kokkos::deep_copy(c.state.fluid.beta, beta);
  Kokkos::deep_copy(c.state.fluid.added_mass, added);
  Kokkos::deep_copy(c.state.fluid.inv_fluid_mass, 1 / share);
  Kokkos::deep_copy(c.state.fluid.acceleration, acceleration);
  Kokkos::deep_copy(c.state.fluid.u_f, u_f);
  Kokkos::parallel_for("test: held", 1, DragOnFrozenGrains{.dt = dt, .on_grains = c.state.fluid});
  const HalfKick kick(dt, {.mass = 1e30,
                           .inertia_moment = 1,
                           .inv_fluid_mass = 1 / share,
                           .beta = beta,
                           .added_mass = added});
  GrainForces f;
  f.u_f = u_f, f.acceleration = acceleration;
  Vec3 u, spin;
  const Vec3 expected = kick(f, u, spin);
  EXPECT_LT(norm(host_copy(c.state.fluid.impulse)(0) - expected), 1e-14 * norm(expected));
  EXPECT_GT(norm(f.u_f - u_f), 0.01) << "the water has slowed down";
}

/// 1,200 grains of a gas that collide within milliseconds, in a box of 3 mm.
InitialGrains gas() {
  InitialGrains g;
  test::Uniform uniform(2);
  const auto u = [&uniform] { return uniform() - 0.5; };
  for (int n = 0; n < 1200; ++n) {
    add_grain(g, 2e-4, {2.1e-4 * (n % 12 + 1), 2.1e-4 * (n / 144 + 1), 2.1e-4 * (n / 12 % 12 + 1)},
              {0.4 * u(), 0.4 * u(), 0.4 * u()});
  }
  return g;
}

/// Angular momentum of all grains about the middle of the box, and the sum of the sizes of their
/// spins' parts [kg m^2/s].
struct AngularMomentum {
  Vec3 total;
  Real spin = 0;
};
AngularMomentum angular_momentum(const GrainBench& c) {
  AngularMomentum sum;
  const auto kin = c.kinematics();
  for (int g = 0; g < c.state.n; ++g) {
    const Vec3 spin = sphere_inertia(kin(g).m, kin(g).r) * kin(g).omega;
    sum.total += kin(g).m * cross(kin(g).x - Vec3{0.005, 0.005, 0.005}, kin(g).u) + spin;
    sum.spin += norm(spin);
  }
  return sum;
}

// Pairs whose grains two chunks share are among these; they add up their forces in a way of their
// own.
TEST(GrainSolver, ManyRollingGrainsKeepTheirAngularMomentum) {
  for (const RollingModel model : RollingModel::all()) {
    Config config = grain_config();
    config.grains->material.rolling_friction = 0.3;
    config.grains->rolling_model = model;
    InitialGrains g = gas();
    for (Vec3& x : g.x) x += Vec3{0.0035, 0.0035, 0.0035};  // away from the walls
    GrainBench c(config, g);
    const AngularMomentum before = angular_momentum(c);
    c.advance(600, 2.5e-6);
    const AngularMomentum after = angular_momentum(c);
    EXPECT_GT(c.state.list.n_inter, 100);
    EXPECT_GT(c.solver.contacts(c.state).n_contacts, 10);
    EXPECT_GT(after.spin, 0) << "they roll";
    EXPECT_LT(norm(after.total - before.total), 1e-11 * after.spin);
  }
}

/// Compares two motions bit for bit.
void expect_same_motion(const GrainBench& one, const GrainBench& other) {
  EXPECT_EQ(one.solver.list().rebuilds(), other.solver.list().rebuilds());
  const auto a = rows_by_id(one.state), b = rows_by_id(other.state);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t id = 1; id < a.size(); ++id) {
    EXPECT_EQ(a[id].x.x, b[id].x.x);
    EXPECT_EQ(a[id].u.y, b[id].u.y);
    EXPECT_EQ(a[id].omega.z, b[id].omega.z);
  }
}

// Grain steps launched ahead of a stale list do nothing until it is rebuilt.
TEST(GrainSolver, LaunchingAheadChangesNothing) {
  Config config = grain_config();
  config.size = {0.003, 0.003, 0.003};
  config.grains->material.rolling_friction = 0.1;
  config.grains->skin = 1e-5;
  GrainBench one(config, gas()), ahead(config, gas());
  ahead.solver.set_sub_steps_ahead(7);
  for (const int n : {1, 40, 100, 259}) {
    one.advance(n, 2.5e-6);
    ahead.advance(n, 2.5e-6);
  }
  EXPECT_GT(one.solver.list().rebuilds(), 10);
  expect_same_motion(one, ahead);
}

// Grain steps of a device that are launched together, as long as the list lives.
TEST(GrainSolver, AGraphChangesNothing) {
  if (kOnHost) GTEST_SKIP() << "a host launches kernels one by one";
  Config config = grain_config();
  config.size = {0.003, 0.003, 0.003};
  config.grains->material.rolling_friction = 0.1;
  GrainBench one(config, gas()), graph(config, gas());
  one.solver.set_graphs(false);
  const test::LaunchCounter counter;
  for (int step = 0; step < 60; ++step) {
    one.advance(20, 2.5e-6);
    graph.advance(20, 2.5e-6);
  }
  EXPECT_GT(counter.launches().at("grains: graph of grain steps"), 10);
  EXPECT_GT(one.solver.list().rebuilds(), 3);
  expect_same_motion(one, graph);
}

// A pair that has parted leaves no force or torque behind, whatever the rolling law remembers.
TEST(GrainSolver, GrainsThatTouchNothingFeelNothing) {
  for (const RollingModel model : {RollingModel::of<NoRolling>(), RollingModel::of<Epsd2>(),
                                   RollingModel::of<ConstantTorque>()}) {
    Config config = grain_config();
    config.size = {0.003, 0.003, 0.003};
    config.grains->material.rolling_friction = 0.1;
    config.grains->rolling_model = model;
    config.grains->wall = config.grains->material;
    GrainBench c(config, gas());
    c.advance(300, 2.5e-6);
    const PairList& list = c.state.list;
    const auto i = host_copy(list.i), j = host_copy(list.j);
    const auto touching = host_copy(list.touching), on_wall = host_copy(c.state.wall_touching);
    const auto force = host_copy(c.state.contact_force), torque = host_copy(c.state.contact_torque);
    std::vector<bool> touches(static_cast<std::size_t>(c.state.n));
    for (int p = 0; p < list.n_pairs; ++p) {
      if (!touching(p)) continue;
      touches[static_cast<std::size_t>(i(p))] = touches[static_cast<std::size_t>(j(p))] = true;
    }
    int n_free = 0, n_wrong = 0;
    for (int g = 0; g < c.state.n; ++g) {
      if (touches[static_cast<std::size_t>(g)] || on_wall(g)) continue;
      ++n_free;
      n_wrong += norm(force(g)) + norm(torque(g)) > 0;
    }
    EXPECT_GT(n_free, 300);
    EXPECT_LT(n_free, c.state.n - 100);
    EXPECT_EQ(n_wrong, 0) << "rolling model " << model.word();
  }
}

// Each call looks for active pairs anew, so this also shows that none is missed between calls.
TEST(GrainSolver, StepsInOneCallEqualCallsOfOneStep) {
  Config config = grain_config();
  config.size = {0.003, 0.003, 0.003};
  config.grains->material.rolling_friction = 0.1;
  config.grains->wall = config.grains->material;
  const InitialGrains g = gas();
  GrainBench together(config, g), apart(config, g);
  for (GrainBench* c : {&together, &apart}) set_weight(c->state, {0, -9.81, 0});
  together.advance(300, 2.5e-6);
  for (int n = 0; n < 300; ++n) apart.advance(1, 2.5e-6);
  EXPECT_GT(together.solver.list().rebuilds(), 3);
  const PairList& list = together.state.list;
  EXPECT_GT(list.chunks.count(), 1);
  EXPECT_GT(list.n_inter, 100);
  const auto a = rows_by_id(together.state), b = rows_by_id(apart.state);
  for (std::size_t n = 1; n < a.size(); ++n) {
    EXPECT_EQ(norm(a[n].x - b[n].x), 0);
    EXPECT_EQ(norm(a[n].omega - b[n].omega), 0);
  }
}

// A glued floor, a top and four sides are all walls that a case can ask for.
TEST(GrainSolver, ANinthWallIsRefused) {
  Config config = grain_config();
  config.grains->floor = GrainFloor::glued;
  config.grains->floor_diameter = 2e-4;
  config.grains->boundary_x = GrainBoundaryX::wall;
  config.grains->boundary_z = GrainBoundaryZ::wall;
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 0.005, 0.005});
  const GrainBench c(config, g);
  WallShapes walls = c.solver.walls();
  EXPECT_EQ(walls.n, 8);
  EXPECT_EQ(walls.n_histories, 5);  // opposite sides share one
  EXPECT_THROW(add_wall(walls, Plane{.normal = {1, 0, 0}}, 0), std::length_error);
  EXPECT_EQ(walls.n, 8);
}

}  // namespace
}  // namespace barchan
