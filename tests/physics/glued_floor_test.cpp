// A floor of glued spheres: where they stand, how a grain rests between them, when it leaves, and
// that it gains no energy from them.
#include <algorithm>
#include <limits>
#include <numbers>

#include "tests/support/grain_bench.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kG = 9.81;            // [m/s^2]
constexpr Real kGluedRadius = 1e-4;  // [m]

Material material(Real mu, Real restitution) {
  return {.youngs_modulus = 1e8,
          .poisson_ratio = 0.3,
          .restitution = restitution,
          .sliding_friction = mu,
          .rolling_friction = 0};
}

/// A box with a glued floor that its spheres fit into without being stretched.
Config glued_box(const Material& m, Real radius) {
  Config config = bench_config(m, 2500, radius);
  const Real a = 2 * kGluedRadius;
  config.size = {36 * a, 20 * a, 20 * a * std::sqrt(Real(3)) / 2};
  config.grains->boundary_x = GrainBoundaryX::periodic;
  config.grains->floor = GrainFloor::glued;
  config.grains->floor_diameter = a;
  return config;
}

Real e_eff(const Config& config) {
  const Elastic e{.youngs_modulus = config.grains->material.youngs_modulus,
                  .poisson_ratio = config.grains->material.poisson_ratio};
  return effective_youngs_modulus(e, e);
}

/// Pocket between three spheres whose corners surround it: (0, 0), (a, 0) and (a/2, b), ten rows
/// further.
Vec3 pocket(const GluedFloor& floor, Real y) {
  return {9.5 * floor.a, y, (10 + Real(1) / 3) * floor.b};
}

// Against all spheres one by one, in a box that stretches the layer and beyond its periodic sides.
TEST(GluedFloor, FindsTheNearestSphereOfAColour) {
  const Real lx = 1.33e-3, lz = 1.1e-3;
  const GluedFloor floor = glued_floor(kGluedRadius, lx, lz);
  EXPECT_NEAR(lx / (3 * floor.a), 2, 1e-12) << "two of each colour in a row";
  EXPECT_NEAR(lz / floor.b, 6, 1e-12) << "rows";
  EXPECT_GE(floor.a, 2 * kGluedRadius);
  Uniform uniform(3);
  for (int n = 0; n < 3000; ++n) {
    const Vec3 x{(2 * uniform() - 0.5) * lx, 1e-4, (2 * uniform() - 0.5) * lz};
    for (int colour = 0; colour < GluedFloor::kColours; ++colour) {
      Real nearest = std::numeric_limits<Real>::infinity();
      for (int j = -12; j < 24; ++j) {
        for (int i = -30; i < 30; ++i) {
          if (((i - j) % 3 + 3) % 3 != colour) continue;
          nearest =
              std::min(nearest, std::hypot(x.x - (i + j / Real(2)) * floor.a, x.z - j * floor.b));
        }
      }
      const Vec3 found = floor.nearest(colour, x);
      ASSERT_NEAR(std::hypot(x.x - found.x, x.z - found.z), nearest, 1e-15);
      const Vec3 image = floor.nearest(colour, x + Vec3{lx, 0, -lz});
      ASSERT_NEAR(norm(image - found - Vec3{lx, 0, -lz}), 0, 1e-15) << "not periodic";
    }
  }
}

// A sphere of radius R on three of radius r: its centre is sqrt((R + r)^2 - a^2/3) above theirs,
// less the overlaps of Hertz with the curvature of both. Each carries a third of the weight.
TEST(GluedFloor, HoldsASphereOnThree) {
  for (const Real ratio : {0.6, 1.0, 2.0}) {
    const Real radius = ratio * kGluedRadius;
    const Config config = glued_box(material(0, 0.2), radius);  // friction would carry a tenth
    const GluedFloor floor = glued_floor(kGluedRadius, config.size[0], config.size[2]);
    InitialGrains g;
    add_grain(g, 2 * radius, pocket(floor, radius));
    GrainBench bench(config, g);
    set_weight(bench.state, {0, -kG, 0});
    bench.advance(200000, 2e-7);
    const GrainKinematics k = bench.grain(1);
    const Real foot = floor.a * floor.a / 3, reach = radius + kGluedRadius;
    const Real steep = std::sqrt(1 - foot / (reach * reach));
    const Real curvature = radius * kGluedRadius / reach;
    const Real force = k.m * kG / (3 * steep);
    const Real overlap = std::pow(3 * force / (4 * e_eff(config) * std::sqrt(curvature)), 2.0 / 3);
    const Real expected = std::sqrt((reach - overlap) * (reach - overlap) - foot) - kGluedRadius;
    const Real rigid = std::sqrt(reach * reach - foot) - kGluedRadius;
    const std::string claim = "sphere of " + std::to_string(ratio).substr(0, 3) + " on three";
    EXPECT_EQ(host_copy(bench.state.wall_touching)(0), 0b111) << claim;
    expect_relative(claim + ", it sinks by", rigid - k.x.y, rigid - expected, 1e-3);
    expect_relative(claim + ", force over weight", bench.contact_force(1).y / (k.m * kG), 1, 1e-6);
    expect_below(claim + ", speed", norm(k.u), 1e-7);
  }
}

// A sphere without resistance to rolling leaves its pocket where its weight points beyond the two
// spheres in front, at tan = (a / (2 sqrt 3)) / height: 19.47 degrees for equal spheres, whatever
// the friction.
TEST(GluedFloor, LetsASphereGoAtTheAngleOfTheSaddle) {
  for (const Real ratio : {0.6, 1.0}) {
    for (const Real mu : {0.0, 0.6}) {
      const Real radius = ratio * kGluedRadius, reach = radius + kGluedRadius;
      const Config config = glued_box(material(mu, 0.2), radius);
      const GluedFloor floor = glued_floor(kGluedRadius, config.size[0], config.size[2]);
      const Real height = std::sqrt(reach * reach - floor.a * floor.a / 3);
      const Real angle = std::atan(floor.a / (2 * std::sqrt(Real(3))) / height);
      for (const Real part : {0.97, 1.03}) {
        InitialGrains g;
        add_grain(g, 2 * radius, pocket(floor, height - kGluedRadius));
        GrainBench bench(config, g);
        const Vec3 start = bench.grain(1).x;
        // Towards the two spheres of the row at smaller z.
        set_weight(bench.state, {0, -kG * std::cos(part * angle), -kG * std::sin(part * angle)});
        bench.advance(150000, 2e-7);
        const Real way = norm(bench.grain(1).x - start) / floor.a;
        std::printf("[ measured ] ratio %.1f, mu %.1f, %.2f of %.2f degrees: %.3g spacings\n",
                    ratio, mu, part, angle * 180 / std::numbers::pi, way);
        EXPECT_EQ(way > 0.5, part > 1);
      }
    }
  }
}

/// Energy of a sphere in flight [J].
Real energy(const GrainKinematics& k) {
  return k.m * (dot(k.u, k.u) + 0.4 * k.r * k.r * dot(k.omega, k.omega)) / 2 + k.m * kG * k.x.y;
}

// A sphere that hops over the layer: from hop to hop its energy stays without friction and damping
// and only falls with them, so that no contact is taken for another one.
TEST(GluedFloor, GivesNoEnergy) {
  for (const bool lossless : {true, false}) {
    const Config config = glued_box(lossless ? material(0, 1) : material(0.6, 0.8), kGluedRadius);
    InitialGrains g;
    add_grain(g, 2 * kGluedRadius, {1e-3, 2e-4, 1e-3}, {0.11, 0, 0.07});
    GrainBench bench(config, g);
    set_weight(bench.state, {0, -kG, 0});
    const Real first = energy(bench.grain(1));
    Real lowest = first, rise = 0;
    int bounces = 0;
    bool touched = false;
    for (int n = 0; n < 50000; ++n) {
      bench.advance(40, 5e-8);
      const bool touches = host_copy(bench.state.wall_touching)(0) != 0;
      bounces += touches && !touched;
      touched = touches;
      if (touches) continue;
      const Real now = energy(bench.grain(1));
      rise = std::max(rise, now - lowest);
      lowest = std::min(lowest, now);
    }
    EXPECT_GT(bounces, 4);
    expect_below(lossless ? "energy gained without loss" : "energy gained with friction",
                 rise / first, lossless ? 1e-5 : 1e-9);
    const Real lost = 1 - lowest / first;
    if (lossless) {
      expect_below("energy lost without loss", lost, 1e-3);
    } else {
      EXPECT_GT(lost, 0.3);
    }
  }
}

}  // namespace
}  // namespace barchan
