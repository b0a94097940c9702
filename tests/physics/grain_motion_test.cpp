// A grain that slides or rolls to rest: closed forms of dem_analytic_motion_tests.csv (standard
// mechanics).
#include <numbers>

#include "tests/support/grain_on_floor.hpp"

namespace barchan {
namespace {

using namespace testing;

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

/// What a sphere that rolls to rest shows.
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

// Under a torque at its limit mu_r R F_n: a = (5/7) mu_r g, t = (7/5) v0/(mu_r g),
// s = (7/10) v0^2/(mu_r g). Then the undamped spring rocks: it lets go of the angle it held.
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
    floor.config.grains->rolling_model = RollingModel::theta_m;
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

}  // namespace
}  // namespace barchan
