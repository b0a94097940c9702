// A column of grains that collapses on a rough floor: its slope grows with either friction.
#include <algorithm>
#include <numbers>

#include "tests/support/packing.hpp"

namespace barchan {
namespace {

using namespace testing;

constexpr int kGrains = 1000;
constexpr Real kCentre = 0.008;  // of the column [m]

/// Angle [degrees] of the wedge with the pile's height of the centre of mass (above the lowest
/// grains) and mean distance from the middle: both are a third of the wedge's height and
/// half-width.
Real wedge_angle(const HostGrains& h) {
  Real height = 0, distance = 0, volume = 0;
  for (int g = 0; g < h.n; ++g) {
    const GrainKinematics& k = h.kin(g);
    height += k.m * (k.x.y - k.r), distance += k.m * std::abs(k.x.x - kCentre), volume += k.m;
  }
  return std::atan(height / distance) * 180 / std::numbers::pi;
}

/// A column 4 mm wide and 3.6 mm high, periodic across; the floor is the same for all frictions.
/// Soft grains: overlaps stay below 1 % of d under 40 Pa.
Real repose_angle(Real mu, Real mu_r) {
  Config config = grain_config();
  config.size = {0.004, 0.006, 0.00135};
  Material& m = config.grains->material;
  m.youngs_modulus = 5e5, m.sliding_friction = mu, m.rolling_friction = mu_r;
  config.grains->wall = m;
  config.grains->wall.sliding_friction = 1, config.grains->wall.rolling_friction = 0.5;
  InitialGrains grains = lattice_packing(kGrains, config.size, 0.005);
  config.size[0] = 2 * kCentre;
  for (Vec3& x : grains.x) x.x += kCentre - 0.002;
  GrainBench bench(config, grains);
  set_weight(bench.state, {0, -9.81, 0});
  bench.advance(20000, 7e-6);
  const HostGrains h(bench.state);
  EXPECT_EQ(h.n, kGrains);
  const Real lift = 1e-8 * 9.81 * 2e-4;  // energy that lifts a grain by its diameter [J]
  EXPECT_LT(h.kinetic_energy() / kGrains, 1e-2 * lift) << "it still flows";
  const Real angle = wedge_angle(h);
  std::printf("[ measured ] angle of repose at mu %.2f, mu_r %.2f: %.2f degrees\n", mu, mu_r,
              angle);
  return angle;
}

TEST(ReposeNightly, GrowsWithSlidingAndRollingFriction) {
  const Real both = repose_angle(0.6, 0.1);
  const Real slippery = repose_angle(0.1, 0.1), medium = repose_angle(0.3, 0.1);
  EXPECT_LT(slippery, medium);
  EXPECT_LT(medium, both);
  const Real smooth = repose_angle(0.6, 0), rough = repose_angle(0.6, 0.3);
  EXPECT_LT(smooth, both);
  EXPECT_LT(both, rough);
}

}  // namespace
}  // namespace barchan
