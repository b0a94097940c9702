// A sphere on a floor, level or sloping, that slides, rolls, rests, bounces or spins: closed forms
// of dem_analytic_motion_tests.csv (standard mechanics).
#include <algorithm>
#include <numbers>

#include "kernels/grains/sphere.hpp"
#include "tests/support/grain_bench.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kG = 9.81;  // [m/s^2]

struct OnFloor {
  Real radius = 0, density = 0;
  Config config;

  OnFloor(const Material& material, Real r, Real rho)
      : radius(r), density(rho), config(bench_config(material, rho, r)) {
    config.size[0] = 1000 * r;
    config.grains->boundary_x = GrainBoundaryX::periodic;
  }
  Real mass() const { return sphere_volume(radius) * density; }
  HertzMindlin law() const {
    const Elastic e{.youngs_modulus = config.grains->material.youngs_modulus,
                    .poisson_ratio = config.grains->material.poisson_ratio};
    return {.e_eff = effective_youngs_modulus(e, e), .g_eff = effective_shear_modulus(e, e)};
  }
  /// Overlap that carries a normal force [m].
  Real overlap_under(Real force) const {
    return std::pow(3 * force / (4 * law().e_eff * std::sqrt(radius)), 2.0 / 3);
  }
  /// The sphere in equilibrium along y, with velocity u and spin about z.
  GrainBench start(Real u, Real omega, Real slope = 0) const {
    const Real weight = mass() * kG * std::cos(slope);
    InitialGrains g;
    add_grain(g, 2 * radius, {20 * radius, radius - overlap_under(weight), 50 * radius}, {u, 0, 0},
              {0, 0, omega});
    GrainBench bench(config, g);
    set_weight(bench.state, {kG * std::sin(slope), -kG * std::cos(slope), 0});
    Kokkos::deep_copy(bench.state.contact_force, Vec3{0, weight, 0});  // balanced from the start
    return bench;
  }
};

/// A stiff material: overlaps of 1e-4 radii.
Material stiff(Real mu, Real mu_r, Real restitution = 0.1) {
  return {.youngs_modulus = 1e8,
          .poisson_ratio = 0.3,
          .restitution = restitution,
          .sliding_friction = mu,
          .rolling_friction = mu_r};
}

// Sphere with v0 and no spin: slides until t = 2 v0/(7 mu g), then rolls with 5/7 v0 (verification
// case DEM04 of MFIX: d = 1 mm, 10000 kg/m^3).
TEST(GrainMotion, SlidesUntilItRollsWithFiveSevenths) {
  const Real v0 = 0.5, dt = 5e-7;
  for (const Real mu : {0.2, 0.6, 1.0}) {
    const OnFloor floor(stiff(mu, 0), 5e-4, 10000);
    GrainBench bench = floor.start(v0, 0);
    const Real end = 2 * v0 / (7 * mu * kG), x0 = bench.grain(1).x.x;
    Real t = 0, t_end = 0, slipped = 0;
    while (t < 1.5 * end) {
      bench.advance(10, dt), t += 10 * dt;
      const GrainKinematics g = bench.grain(1);
      if (t_end == 0 && g.u.x + g.r * g.omega.z <= 0) t_end = t, slipped = g.x.x - x0;
    }
    const GrainKinematics g = bench.grain(1);
    const std::string claim = "slip to roll, mu " + std::to_string(mu).substr(0, 3);
    expect_relative(claim + ", v/v0", g.u.x / v0, 5.0 / 7, 5e-4);
    expect_relative(claim + ", R omega/v0", -g.r * g.omega.z / v0, 5.0 / 7, 5e-4);
    expect_relative(claim + ", mu g t/v0", mu * kG * t_end / v0, 2.0 / 7, 6e-3);
    expect_relative(claim + ", distance of the centre", slipped, 12.0 / 49 * v0 * v0 / (mu * kG),
                    0.012);
  }
}

/// Stop of a sphere that rolls to rest.
struct RollingStop {
  Real deceleration = 0, time = 0, distance = 0;  // until the first reversal
  Real swing = 0, period = 0;                     // of the rocking afterwards [m], [s]
  Real last_speed = 0;                            // largest speed in the last period [m/s]
};

RollingStop roll_to_rest(const OnFloor& floor, Real v0, Real dt, Real rocking_time) {
  GrainBench bench = floor.start(v0, -v0 / floor.radius);
  RollingStop r;
  const Real x0 = bench.grain(1).x.x;
  Real t = 0, v_early = 0, t_early = 0, low = 1e30, high = -1e30, previous = v0, first_up = 0;
  int upward = 0;
  while (r.time == 0 || t < r.time + rocking_time) {
    bench.advance(10, dt), t += 10 * dt;
    const GrainKinematics g = bench.grain(1);
    const Real v = -floor.radius * g.omega.z;
    if (r.time == 0) {
      // Slope of v over the middle of the way, away from loading and stop.
      if (v_early == 0 && v < 0.7 * v0) v_early = v, t_early = t;
      if (v > 0.3 * v0 && v_early != 0) r.deceleration = (v_early - v) / (t - t_early);
      if (v <= 0) r.time = t, r.distance = g.x.x - x0;
    } else {
      low = std::min(low, g.x.x), high = std::max(high, g.x.x);
      if (previous < 0 && v >= 0) {  // a full period lies between two of these
        if (upward == 0)
          first_up = t;
        else
          r.period = (t - first_up) / upward;
        ++upward;
      }
      if (t > r.time + 0.75 * rocking_time) r.last_speed = std::max(r.last_speed, std::abs(v));
    }
    previous = v;
  }
  r.swing = high - low;
  return r;
}

// Torque at its limit mu_r R F_n: a = (5/7) mu_r g, t = (7/5) v0/(mu_r g), s = (7/10) v0^2/(mu_r
// g). Then the undamped spring rocks: it lets go of the angle it held.
TEST(GrainMotion, RollsToRestUnderEpsd2) {
  const Real mu_r = 0.2, v0 = 1;
  Material material{.youngs_modulus = 2e5,
                    .poisson_ratio = 0.3,
                    .restitution = 0.1,
                    .sliding_friction = 0.3,
                    .rolling_friction = mu_r};
  const OnFloor floor(material, 0.5, 1 / sphere_volume(0.5));
  const RollingStop r = roll_to_rest(floor, v0, 2e-5, 0.5);
  expect_relative("EPSD2, deceleration", r.deceleration, 5.0 / 7 * mu_r * kG, 0.01);
  expect_relative("EPSD2, stop time", r.time, 1.4 * v0 / (mu_r * kG), 0.01);
  expect_relative("EPSD2, stop distance", r.distance, 0.7 * v0 * v0 / (mu_r * kG), 0.01);
  // k_r = k_t R^2 holds the limit at this angle.
  const Real weight = floor.mass() * kG;
  const Real angle =
      mu_r * weight /
      (floor.law()(floor.radius, floor.mass(), floor.overlap_under(weight)).k_t * floor.radius);
  expect_absolute("EPSD2, rocking, swing over stop distance", r.swing / r.distance, 0, 0.01);
  // Released are the rolling spring and the tangential one, which held (5/7) mu_r W: each swings
  // by at most twice what it held.
  EXPECT_LT(r.swing, 2 * (1 + 5.0 / 7) * angle * floor.radius);
  std::printf("[ measured ] EPSD2, swing over held angle R: %.4f, spin at the end %.3g rad/s\n",
              r.swing / (angle * floor.radius), r.last_speed / floor.radius);
}

// The paper's A12, A13: the torque reaches mu_r R F_n at the angle theta_m, so that
//   (7/10) m v0^2 = mu_r m g (s - theta_m R/2)
// and the sphere then rocks as (7/5) m R^2 theta'' = -(mu_r R m g/theta_m) theta.
TEST(GrainMotion, RollsToRestUnderThePapersThetaM) {
  const Real mu_r = 0.2, r = 1e-4, v0 = 0.05;
  for (const Real theta_m : {0.1, 0.5}) {
    OnFloor floor(stiff(0.6, mu_r), r, 2500);
    floor.config.grains->rolling_model = RollingModel::of<ThetaM>();
    floor.config.grains->rolling_theta_m = theta_m;
    const Real period = 2 * std::numbers::pi * std::sqrt(1.4 * r * theta_m / (mu_r * kG));
    const RollingStop stop = roll_to_rest(floor, v0, 5e-7, 3 * period);
    const std::string claim = "theta_m " + std::to_string(theta_m).substr(0, 3);
    expect_relative(claim + ", deceleration", stop.deceleration, 5.0 / 7 * mu_r * kG, 0.01);
    // Loading takes the part asin(...) of a period; then the deceleration is constant.
    const Real w = 2 * std::numbers::pi / period, a = 5.0 / 7 * mu_r * kG, travel = theta_m * r;
    const Real load = std::asin(travel * w / v0) / w, v1 = std::sqrt(v0 * v0 - a * travel);
    expect_relative(claim + ", stop time", stop.time, load + v1 / a, 0.01);
    expect_relative(claim + ", stop distance", stop.distance,
                    0.7 * v0 * v0 / (mu_r * kG) + travel / 2, 0.01);
    expect_relative(claim + ", swing", stop.swing, 2 * travel, 0.01);
    expect_relative(claim + ", period", stop.period, period, 0.01);
  }
}

// --- The grain of Table II on a slope, at rest, in flight.

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
  for (const RollingModel model : {RollingModel::of<Epsd2>(), RollingModel::of<ThetaM>(),
                                   RollingModel::of<ConstantTorque>()}) {
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
  for (const RollingModel model : {RollingModel::of<Epsd2>(), RollingModel::of<ThetaM>()}) {
    for (const Real part : {0.4, 0.9}) {
      const Real slope = std::atan(part * mu_r);
      const OnFloor floor = rolling_floor(model, mu_r);
      const Real normal = floor.mass() * kG * std::cos(slope);
      const Real k_t = floor.law()(kRadius, floor.mass(), floor.overlap_under(normal)).k_t;
      const bool paper = model.is<ThetaM>();
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
