// Bodies: distances against points on the surface, found by marching along rays.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "kernels/bodies/body.hpp"
#include "src/bodies/make_bodies.hpp"
#include "src/case/config.hpp"

namespace barchan {
namespace {

constexpr std::array<double, 3> kDomain{0.1, 0.04, 0.08};

/// Bodies, one of each form.
std::vector<BodyConfig> all_bodies() {
  using S = BodyShape;
  const std::array<double, 2> at{0.05, 0.04};
  return {{.name = "cylinder",
           .shape = S::of<shapes::Cylinder>(),
           .centre = at,
           .radius = 0.006,
           .height = 0.01},
          {.name = "along x",
           .shape = S::of<shapes::Cylinder>(),
           .centre = at,
           .base = 0.005,
           .axis = Axis::x,
           .radius = 0.006,
           .length = 0.02},
          {.name = "along z",
           .shape = S::of<shapes::Cylinder>(),
           .centre = at,
           .base = 0.005,
           .axis = Axis::z,
           .radius = 0.006,
           .length = 0.02},
          {.name = "sphere",
           .shape = S::of<shapes::Sphere>(),
           .centre = at,
           .base = 0.004,
           .radius = 0.006},
          {.name = "half sphere",
           .shape = S::of<shapes::HalfSphere>(),
           .centre = at,
           .base = 0.004,
           .radius = 0.006},
          {.name = "box",
           .shape = S::of<shapes::Box>(),
           .centre = at,
           .base = 0.002,
           .height = 0.008,
           .size = {0.02, 0.01},
           .angle = 0.5},
          {.name = "fence",
           .shape = S::of<shapes::Fence>(),
           .centre = at,
           .radius = 0.002,
           .height = 0.01,
           .length = 0.018,
           .spacing = 0.006,
           .angle = 0.3}};
}

Body body_of(const BodyConfig& config) {
  Config c;
  c.size = kDomain;
  c.bodies = {config};
  return make_bodies(c.bodies, c.size).body[0];
}

class Samples {
 public:
  Vec3 place(double margin = 0.018) {
    return {0.05 + margin * unit(), 0.008 + 0.5 * margin * unit(), 0.04 + margin * unit()};
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  std::mt19937 random_{1};
};

TEST(Bodies, ADistanceLeadsToTheSurface) {
  for (const BodyConfig& config : all_bodies()) {
    const Body body = body_of(config);
    Samples samples;
    for (int n = 0; n < 2000; ++n) {
      const Vec3 x = samples.place();
      const ToSurface at = body.to_surface(x);
      EXPECT_NEAR(norm(at.normal), 1, 1e-12) << config.name;
      EXPECT_NEAR(body.distance(x - at.distance * at.normal), 0, 1e-14) << config.name;
    }
  }
}

/// Consequence: no place on the surface is nearer than a distance says.
TEST(Bodies, NoDistanceGrowsFasterThanTheWay) {
  for (const BodyConfig& config : all_bodies()) {
    const Body body = body_of(config);
    Samples samples;
    for (int n = 0; n < 5000; ++n) {
      const Vec3 a = samples.place(), b = samples.place();
      EXPECT_LE(std::abs(body.distance(a) - body.distance(b)), norm(a - b) * (1 + 1e-12))
          << config.name;
    }
  }
}

TEST(Bodies, TheNormalIsTheGradientOfTheDistance) {
  std::vector<BodyConfig> bodies = all_bodies();
  bodies.push_back({.name = "wave",
                    .shape = BodyShape::of<shapes::Wave>(),
                    .height = 0.004,
                    .wavelength = 0.05});
  bodies.push_back({.name = "dune",
                    .shape = BodyShape::of<shapes::Dune>(),
                    .centre = {0.05, 0.04},
                    .height = 0.006,
                    .size = {0.03, 0.02},
                    .lee = 0.01});
  for (const BodyConfig& config : bodies) {
    const Body body = body_of(config);
    Samples samples;
    int smooth = 0;
    for (int n = 0; n < 2000; ++n) {
      const Vec3 x = samples.place();
      const ToSurface at = body.to_surface(x);
      // Hills have the exact gradient on the surface alone.
      const bool hill = config.shape.is<shapes::Wave>() || config.shape.is<shapes::Dune>();
      const Vec3 place = hill ? x - at.distance * at.normal : x;
      if (hill && std::abs(body.distance(place)) > 1e-5) continue;
      const double h = 1e-8;
      const Vec3 normal = body.to_surface(place).normal;
      const auto slope = [&](const Vec3& e) {
        return (body.distance(place + h * e) - body.distance(place - h * e)) / (2 * h);
      };
      const Vec3 gradient{slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})};
      smooth += norm(gradient - normal) < (hill ? 1e-2 : 1e-5);
    }
    EXPECT_GT(smooth, 900) << config.name;
    if (!config.shape.is<shapes::Wave>() && !config.shape.is<shapes::Dune>()) {
      EXPECT_GT(smooth, 1980) << config.name;  // the rest is next to an edge
    }
  }
}

/// Volume inside, by the share of random places that are.
TEST(Bodies, ThereIsAsMuchInsideAsTheShapeHolds) {
  const double pi = 3.14159265358979, r = 0.006;
  const std::vector<double> volumes{pi * r * r * 0.01,
                                    pi * r * r * 0.02,
                                    pi * r * r * 0.02,
                                    4 * pi / 3 * r * r * r,
                                    2 * pi / 3 * r * r * r,
                                    0.02 * 0.01 * 0.008,
                                    4 * pi * 0.002 * 0.002 * 0.01};
  const std::vector<BodyConfig> bodies = all_bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body body = body_of(bodies[b]);
    Samples samples;
    const int n = 200000;
    int inside = 0;
    for (int i = 0; i < n; ++i) inside += body.distance(samples.place(0.019)) < 0;
    const double box = std::pow(2 * 0.019, 3) / 2;
    const double share = volumes[b] / box;
    EXPECT_NEAR(static_cast<double>(inside) / n, share, 4 * std::sqrt(share / n)) << bodies[b].name;
  }
}

/// A dune's foot, crest and slopes; a wave's crests and troughs.
TEST(Bodies, HillsAreAsHighAsTheyShould) {
  const Body dune = body_of({.name = "dune",
                             .shape = BodyShape::of<shapes::Dune>(),
                             .centre = {0.05, 0.04},
                             .height = 0.006,
                             .size = {0.03, 0.02},
                             .lee = 0.01});
  EXPECT_NEAR(dune.distance({0.05, 0.006, 0.04}), 0, 1e-15);
  EXPECT_NEAR(dune.distance({0.03, 0, 0.04}), 0, 1e-15);
  EXPECT_NEAR(dune.distance({0.06, 0, 0.04}), 0, 1e-15);
  EXPECT_NEAR(dune.distance({0.05, 0, 0.05}), 0, 1e-15);
  // The lee side is a plane along the axis: exact away from the surface as well.
  EXPECT_NEAR(dune.distance({0.055, 0.003 + 0.002, 0.04}),
              0.002 * std::cos(std::atan(0.006 / 0.01)), 1e-15);
  const Body wave = body_of({.name = "wave",
                             .shape = BodyShape::of<shapes::Wave>(),
                             .centre = {0.01, 0},
                             .base = 0.001,
                             .height = 0.004,
                             .wavelength = 0.05});
  EXPECT_NEAR(wave.distance({0.01, 0.005, 0.02}), 0, 1e-15);
  EXPECT_NEAR(wave.distance({0.06, 0.007, 0.07}), 0.002, 1e-15);
  EXPECT_NEAR(wave.distance({0.035, 0.002, 0.02}), 0.001, 1e-15);
}

/// Bodies that leave the domain at a side come in at the other one.
TEST(Bodies, AreSeenThroughThePeriodicSides) {
  for (const BodyConfig& config : all_bodies()) {
    const Body body = body_of(config);
    Samples samples;
    for (int n = 0; n < 200; ++n) {
      const Vec3 x = samples.place();
      EXPECT_NEAR(body.distance(x), body.distance({x.x - kDomain[0], x.y, x.z + kDomain[2]}), 1e-15)
          << config.name;
    }
  }
}

TEST(Bodies, TheNearestIsTheOneThatIsDeepest) {
  Config c;
  c.size = kDomain;
  c.bodies = {{.name = "a",
               .shape = BodyShape::of<shapes::Sphere>(),
               .centre = {0.02, 0.04},
               .radius = 0.005},
              {.name = "b",
               .shape = BodyShape::of<shapes::Sphere>(),
               .centre = {0.06, 0.04},
               .radius = 0.01}};
  const Bodies bodies = make_bodies(c.bodies, c.size);
  EXPECT_EQ(bodies.nearest({0.03, 0.005, 0.04}).body, 0);
  EXPECT_EQ(bodies.nearest({0.045, 0.01, 0.04}).body, 1);
  EXPECT_NEAR(bodies.nearest({0.06, 0.013, 0.04}).surface.distance, -0.007, 1e-15);
  EXPECT_EQ(Bodies{}.nearest({}).body, -1);
}

}  // namespace
}  // namespace barchan
