// A grain that rests, bounces, spins, or goes down a slope: closed forms of
// dem_analytic_motion_tests.csv (standard mechanics).
#include <algorithm>

#include "tests/support/grain_on_floor.hpp"

namespace barchan {
namespace {

using namespace testing;

constexpr Real kRadius = 1e-4, kDensity = 2500, kStep = 5e-7;

/// Acceleration of the centre along x and of the spin over the second half of `time`.
struct Acceleration {
  Real linear = 0, angular = 0;
};

Acceleration accelerate(const OnFloor& floor, Real slope, Real time) {
  GrainBench bench = floor.start(0, 0, slope);
  const int half = static_cast<int>(time / kStep / 2);
  bench.advance(half, kStep);
  const GrainKinematics a = bench.grain(1);
  bench.advance(half, kStep);
  const GrainKinematics b = bench.grain(1);
  return {(b.u.x - a.u.x) / (half * kStep), -(b.omega.z - a.omega.z) / (half * kStep)};
}

TEST(GrainSlope, RollsDownWithFiveSeventhsOrSlips) {
  const Real slope = 0.5;  // [rad], tan = 0.546
  for (const Real mu : {0.6, 0.2, 0.1, 0.05}) {
    const OnFloor floor(stiff(mu, 0), kRadius, kDensity);
    const Acceleration a = accelerate(floor, slope, 0.02);
    const bool rolls = mu >= 2.0 / 7 * std::tan(slope);
    const std::string claim = rolls ? "incline, rolls" : "incline, slips";
    const Real expected =
        rolls ? 5.0 / 7 * kG * std::sin(slope) : kG * (std::sin(slope) - mu * std::cos(slope));
    const Real spin = rolls ? expected / kRadius : 2.5 * mu * kG * std::cos(slope) / kRadius;
    expect_relative(claim + ", a", a.linear, expected, 5e-3);
    expect_relative(claim + ", angular", a.angular, spin, 5e-3);
  }
}

OnFloor rolling_floor(RollingModel model, Real mu_r) {
  OnFloor floor(stiff(0.6, mu_r), kRadius, kDensity);
  floor.config.grains->rolling_model = model;
  floor.config.grains->rolling_theta_m = 0.01;
  return floor;
}

// tan(slope) > mu_r: pure rolling with a = (5/7) g cos(slope) (tan(slope) - mu_r).
TEST(GrainSlope, RollsWhenTheSlopeExceedsRollingFriction) {
  const Real mu_r = 0.2;
  for (const RollingModel model : {RollingModel::epsd2, RollingModel::theta_m, RollingModel::cdt}) {
    for (const Real slope : {0.25, 0.4}) {
      const Acceleration a = accelerate(rolling_floor(model, mu_r), slope, 0.04);
      expect_relative("rolling down, a", a.linear,
                      5.0 / 7 * kG * std::cos(slope) * (std::tan(slope) - mu_r), 0.01);
    }
  }
}

// tan(slope) <= mu_r: the sphere stays. Let go at rest, the drive d (as a part of the limit) swings
// the undamped rolling spring, which holds its limit at the angle theta_s, to 2 d theta_s, or, if
// that passes the limit, to (1 + (d - 1/2)/(1 - d)) theta_s, by the balance of energy.
TEST(GrainSlope, StaysWhenRollingFrictionHolds) {
  const Real mu_r = 0.2;
  for (const RollingModel model : {RollingModel::epsd2, RollingModel::theta_m}) {
    for (const Real part : {0.4, 0.9}) {
      const Real slope = std::atan(part * mu_r);
      const OnFloor floor = rolling_floor(model, mu_r);
      const Real normal = floor.mass() * kG * std::cos(slope);
      const Real k_t = floor.law()(kRadius, floor.mass(), floor.overlap_under(normal)).k_t;
      const bool paper = model == RollingModel::theta_m;
      const Real held = paper ? 0.01 : mu_r * normal / (k_t * kRadius);
      GrainBench bench = floor.start(0, 0, slope);
      const Real x0 = bench.grain(1).x.x;
      Real farthest[2] = {0, 0};
      for (int n = 0; n < 20000; ++n) {
        bench.advance(10, kStep);
        Real& x = farthest[n / 10000];
        x = std::max(x, bench.grain(1).x.x - x0);
      }
      const Real expected =
          held * kRadius * (part <= 0.5 ? 2 * part : 1 + (part - 0.5) / (1 - part));
      if (paper) {
        expect_relative("held on the slope, farthest", farthest[0], expected, 0.01);
      } else {  // the tangential spring, as stiff as the rolling one, yields beside it
        expect_absolute("held on the slope, farthest", farthest[0], 0, 2 * expected);
      }
      EXPECT_LE(farthest[1], farthest[0] * (1 + 1e-3)) << "it creeps";
    }
  }
}

// delta = (3 W/(4 E sqrt(R)))^(2/3).
TEST(GrainAtRest, OverlapCarriesTheWeight) {
  for (const Real r : {7.5e-5, 1e-4, 5e-3}) {
    const OnFloor floor(Material{}, r, kDensity);
    InitialGrains g;
    add_grain(g, 2 * r, {50 * r, r, 50 * r});
    GrainBench bench(floor.config, g);
    set_weight(bench.state, {0, -kG, 0});
    const Real expected = floor.overlap_under(floor.mass() * kG);
    bench.advance(20000, 0.02 * std::sqrt(expected / kG));  // 60 periods of the resting sphere
    const GrainKinematics rest = bench.grain(1);
    expect_relative("static overlap", r - rest.x.y, expected, 1e-3);
    expect_relative("static force", bench.contact_force(1).y, floor.mass() * kG, 1e-3);
    expect_absolute("speed at rest over sqrt(g delta)", norm(rest.u) / std::sqrt(kG * expected), 0,
                    1e-6);
  }
}

/// Heights of the rebounds of a ball dropped from h [m], in flight: gap + v^2/(2 g).
/// A stiff ball: the weight must not count while it touches.
std::vector<Real> rebounds(Real modulus, Real restitution, int n, Real dt) {
  const Real h = 0.5;
  const OnFloor floor({.youngs_modulus = modulus, .poisson_ratio = 0.3, .restitution = restitution},
                      0.1, 2600);
  InitialGrains g;
  add_grain(g, 0.2, {5, 0.1 + h, 5});
  GrainBench bench(floor.config, g);
  set_weight(bench.state, {0, -kG, 0});
  std::vector<Real> heights;
  bool touched = false;
  while (static_cast<int>(heights.size()) < n) {
    bench.advance(20, dt);
    const GrainKinematics b = bench.grain(1);
    const Real gap = b.x.y - b.r;
    if (gap < 0)
      touched = true;
    else if (touched)
      heights.push_back(gap + b.u.y * b.u.y / (2 * kG)), touched = false;
  }
  return heights;
}

TEST(BouncingBall, RebundsFallWithTheSquareOfRestitution) {
  for (const Real e : {0.7, 0.8, 0.9}) {
    const auto heights = rebounds(1e10, e, 4, 5e-6);
    Real before = 0.5;
    for (std::size_t k = 0; k < heights.size(); ++k) {
      expect_relative("rebound " + std::to_string(k + 1), heights[k] / before, e * e, 0.01);
      before = heights[k];
    }
  }
}

TEST(BouncingBall, LosesNothingUndamped) {
  const auto heights = rebounds(1e9, 1, 16, 2e-5);
  expect_relative("16th undamped rebound", heights.back(), 0.5, 1e-3);
}

// Spin about the contact normal meets no torque (EPSD2 has none for torsion): unchanged.
TEST(Torsion, SpinAboutTheNormalIsFree) {
  const Real spin = 123.456;
  OnFloor floor(stiff(0.6, 0.3), kRadius, kDensity);
  GrainBench resting = [&] {
    InitialGrains g;
    add_grain(g, 2 * kRadius, {20 * kRadius, kRadius, 50 * kRadius}, {}, {0, spin, 0});
    return GrainBench(floor.config, g);
  }();
  set_weight(resting.state, {0, -kG, 0});
  resting.advance(20000, kStep);
  EXPECT_GT(resting.contact_force(1).y, 0) << "it does touch";
  EXPECT_EQ(resting.grain(1).omega.y, spin);
  EXPECT_EQ(norm(resting.grain(1).omega), spin);

  InitialGrains g;
  add_grain(g, 2 * kRadius, {0.005, 0.005, 0.005}, {0.05, 0, 0}, {spin, 0, 0});
  add_grain(g, 2 * kRadius, {0.005 + 2.0001 * kRadius, 0.005, 0.005}, {-0.05, 0, 0});
  GrainBench pair(floor.config, g);
  pair.advance(2000, 1e-7);
  EXPECT_LT(pair.grain(1).u.x, 0) << "they did collide";
  EXPECT_EQ(pair.grain(1).omega.x, spin);
  // The unit normal of a pair is one to round-off only.
  EXPECT_LT(norm(pair.grain(2).omega), 1e-15 * spin);
}

}  // namespace
}  // namespace barchan
