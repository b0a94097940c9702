// The longest stable grain step against oscillators, a lone contact and a packing.
#include "kernels/grains/stable_step.hpp"

#include <cmath>

#include "tests/support/clumps.hpp"
#include "tests/support/packing.hpp"

namespace barchan {
namespace {

using namespace test;

/// Amplitude of an oscillator after 2,000 steps over that at first, in the order of the grain
/// steps.
Real growth(Real k, Real gamma, Real m, Real dt) {
  Real x = 1, u = 0;
  for (int s = 0; s < 2000 && std::abs(x) < 1e6; ++s) {
    u += dt / m * (-k * x - gamma * u);
    x += dt * u;
  }
  return std::abs(x) + dt * std::abs(u);
}

TEST(StableStep, IsWhereAnOscillatorBeginsToGrow) {
  for (const Real gamma : {0.0, 0.3, 2.0, 20.0}) {
    const Real k = 2, m = 0.5, limit = stable_step(k, gamma, m);
    EXPECT_LT(growth(k, gamma, m, 0.99 * limit), 20) << gamma;
    EXPECT_GT(growth(k, gamma, m, 1.01 * limit), 1e3) << gamma;
  }
  EXPECT_DOUBLE_EQ(stable_step(2, 0, 0.5), 1);     // 2 sqrt(m/k)
  EXPECT_DOUBLE_EQ(stable_step(0, 4, 0.5), 0.25);  // 2 m/gamma
}

Config soft_grains(double tangential_damping = 1) {
  Config config = grain_config();
  config.grains->tangential_damping = tangential_damping;
  Material& m = config.grains->material;
  m.youngs_modulus = 2e4, m.restitution = 0.1, m.sliding_friction = 0.6;
  config.grains->wall = m;
  return config;
}

/// A grain that lies on the floor and is given a spin: how fast its surface slips in the end over
/// how fast at first. `ratio`: the grain step over the stable one.
Real slip_left(Real ratio, double tangential_damping) {
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 1e-4, 0.005});
  GrainBench bench(soft_grains(tangential_damping), g);
  set_weight(bench.state, {0, -9.81, 0});
  bench.advance(20000, 1e-6);
  const auto kin = bench.kinematics();
  kin(0).omega.z = 1e-6;
  Kokkos::deep_copy(bench.state.kin, kin);
  bench.advance(600, ratio * bench.solver.stable_step(bench.state));
  const GrainKinematics grain = bench.grain(1);
  return std::abs(grain.u.x + grain.r * grain.omega.z) / (grain.r * 1e-6);
}

TEST(StableStep, OfAGrainOnTheFloorIsWhereItsSlipBeginsToGrow) {
  for (const double tangential_damping : {1.0, 0.25}) {
    EXPECT_LT(slip_left(0.95, tangential_damping), 0.01);
    EXPECT_GT(slip_left(1.05, tangential_damping), 1);
  }
}

/// Four spheres in a row that lie on the floor and are given a spin about their axis: slip after
/// 100 steps over that at first. Later friction ends what grows.
Real slip_left_of_a_rod(Real ratio, double tangential_damping) {
  Config config = soft_grains(tangential_damping);
  config.grains->shape = {.shape = GrainShape::clump, .spheres = rod()};
  const Real r = 1e-4 / std::cbrt(Real(4)), omega = 1e-6;
  InitialGrains g;
  add_turned(g, 2e-4, {0.005, r, 0.005}, {1, 0, 0, 0});
  ClumpBench bench(config, g);
  set_weight(bench.state, {0, -9.81, 0});
  bench.advance(20000, 1e-6);
  const auto clump = host_copy(bench.state.clump);
  const int head = host_copy(bench.state.members.entry)(0);
  clump(head).j.x += 0.4 * clump(head).m * r * r * omega;
  Kokkos::deep_copy(bench.state.clump, clump);
  bench.advance(100, ratio * bench.solver.stable_step(bench.state));
  const GrainKinematics grain = bench.grain(1);
  return std::abs(grain.u.z - r * grain.omega.x) / (r * omega);
}

TEST(StableStep, OfARodOnTheFloorIsWhereItsSlipBeginsToGrow) {
  for (const double tangential_damping : {1.0, 0.25}) {
    EXPECT_LT(slip_left_of_a_rod(0.95, tangential_damping), 0.01);
    EXPECT_GT(slip_left_of_a_rod(1.05, tangential_damping), 1);
  }
}

/// 400 grains that have settled on the floor go on for 0.02 s: their energy over that of an
/// overlap of 1e-4 d under the weight of one.
Real energy_of_still_grains(Real ratio) {
  Config config = soft_grains();
  config.size = {0.0015, 0.006, 0.00135};
  config.grains->boundary_x = GrainBoundaryX::wall;
  GrainBench bench(config, lattice_packing(400, config.size, 0.005, 1));
  set_weight(bench.state, {0, -9.81, 0});
  bench.advance(60000, 1e-5);
  const Real dt = ratio * bench.solver.stable_step(bench.state);
  bench.advance(static_cast<int>(0.02 / dt), dt);
  const HostGrains h(bench.state);
  return h.kinetic_energy() / h.n / (1e-8 * 9.81 * 2e-8);
}

TEST(StableStep, BeyondItAPackingShakes) {
  const Real below = energy_of_still_grains(0.85), above = energy_of_still_grains(1.3);
  EXPECT_LT(below, 1e-4);
  EXPECT_GT(above, 100 * below);
}

TEST(StableStep, IsInfiniteWithoutContactsOrFriction) {
  InitialGrains g;
  add_grain(g, 2e-4, {0.005, 5e-4, 0.005});
  GrainBench apart(soft_grains(), g);
  EXPECT_TRUE(std::isinf(apart.solver.stable_step(apart.state)));
  Config smooth = soft_grains();
  smooth.grains->material.sliding_friction = smooth.grains->wall.sliding_friction = 0;
  g.x[0].y = 0.99e-4;
  GrainBench touching(smooth, g);
  EXPECT_TRUE(std::isinf(touching.solver.stable_step(touching.state)));
}

}  // namespace
}  // namespace barchan
