// Shape of clumps of spheres against closed forms, and what the quadrature converges to.
#include "src/grains/clump_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/grains/sphere.hpp"
#include "src/grains/named_clumps.hpp"

namespace barchan {
namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;
using Spheres = std::vector<ClumpSphere>;

Real volume(const ClumpShape& shape) { return sphere_volume(shape.diameter / 2); }
/// In the unit of the given spheres: principal moments over the mass, surface.
Vec3 inertia(const ClumpShape& shape) { return shape.diameter * shape.diameter * shape.inertia; }
Real surface(const ClumpShape& shape) { return shape.diameter * shape.diameter * shape.surface; }

void expect_near(const Vec3& a, const Vec3& b, Real tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Spheres rotated, shifted and in another unit.
Spheres moved(Spheres spheres, const Quaternion& q, const Vec3& by, Real scale) {
  for (auto& [c, radius] : spheres) c = scale * rotate(q, c) + by, radius *= scale;
  return spheres;
}
const Quaternion kTilt = rotation_about({0.48, 0.6, 0.64}, 1.234);

/// Part of a unit sphere with x >= -h: volume, integrals of (y^2 + z^2) and of (x + h)^2, surface.
struct Cap {
  Real h;
  Real volume() const { return kPi * (2. / 3 + h - h * h * h / 3); }
  Real axial() const { return kPi / 2 * (8. / 15 + h - 2. / 3 * h * h * h + std::pow(h, 5) / 5); }
  Real along() const {  // int pi (1 - x^2)(x + h)^2 dx from -h to 1
    const auto antiderivative = [&](Real x) {
      return x * x * x / 3 + h * x * x + h * h * x - std::pow(x, 5) / 5 - h * std::pow(x, 4) / 2 -
             h * h * x * x * x / 3;
    };
    return kPi * (antiderivative(1) - antiderivative(-h));
  }
  Real surface() const { return 2 * kPi * (1 + h); }
};

TEST(ClumpShape, OneSphereIsASphere) {
  const ClumpShape shape = clump_shape({{{1, 2, 3}, 0.7}});
  EXPECT_NEAR(shape.diameter, 1.4, 1e-14);
  expect_near(shape.centre, {1, 2, 3}, 1e-14);
  expect_near(shape.inertia, {0.1, 0.1, 0.1}, 1e-14);
  EXPECT_NEAR(shape.bounding_radius, 0.5, 1e-14);
  EXPECT_NEAR(shape.surface, kPi, 1e-13);
  EXPECT_NEAR(shape.sphericity(), 1, 1e-14);
  expect_near(shape.projected_areas, {kPi / 4, kPi / 4, kPi / 4}, 1e-14);
  EXPECT_EQ(shape.shares, std::vector<Real>{1});
  EXPECT_EQ(shape.principal_axes.w, 1);
}

TEST(ClumpShape, TwoThatTouchAreTwiceOne) {
  const ClumpShape shape = clump_shape(moved({{{-1, 0, 0}, 1}, {{1, 0, 0}, 1}}, kTilt, {}, 2));
  EXPECT_NEAR(volume(shape), 2 * sphere_volume(2), 1e-12);
  expect_near(inertia(shape), {4 * 0.4, 4 * 1.4, 4 * 1.4}, 1e-12);
  EXPECT_NEAR(surface(shape), 8 * kPi * 4, 1e-11);
  EXPECT_NEAR(shape.bounding_radius * shape.diameter, 4, 1e-13);
  EXPECT_NEAR(shape.shares[0], 0.5, 1e-14);
  // Along the axis one hides the other.
  const Real square = shape.diameter * shape.diameter;
  expect_near(square * shape.projected_areas, {4 * kPi, 8 * kPi, 8 * kPi}, 1e-11);
}

// Halves of the union are parts of spheres beyond the plane midway.
TEST(ClumpShape, TwoThatOverlapAreTwoPartsOfSpheres) {
  for (const Real h : {0.02, 0.3, 0.5, 0.95}) {
    const Cap half{h};
    const ClumpShape shape = clump_shape(moved({{{-h, 0, 0}, 1}, {{h, 0, 0}, 1}}, kTilt, {}, 1));
    const Real lens = kPi * (4 + 2 * h) * (2 - 2 * h) * (2 - 2 * h) / 12;
    EXPECT_NEAR(volume(shape), 2 * sphere_volume(1) - lens, 1e-12) << h;
    EXPECT_NEAR(volume(shape), 2 * half.volume(), 1e-12) << h;
    const Real axial = half.axial() / half.volume();
    const Real across = axial / 2 + half.along() / half.volume();
    expect_near(inertia(shape), {axial, across, across}, 1e-12);
    EXPECT_NEAR(surface(shape), 2 * half.surface(), 1e-11) << h;
    const Real shadow = 2 * kPi - 2 * (std::acos(h) - h * std::sqrt(1 - h * h));
    EXPECT_NEAR(shape.projected_areas.y * std::pow(shape.diameter, 2), shadow, 1e-12) << h;
    EXPECT_NEAR(shape.projected_areas.x * std::pow(shape.diameter, 2), kPi, 1e-12) << h;
  }
}

// The face between two shares is the disc of the circle in which the spheres meet.
TEST(ClumpShape, SharesOfUnequalSpheresMeetWhereTheyDo) {
  const Real r = 0.6, d = 1.1, h = (d * d + 1 - r * r) / (2 * d);
  const ClumpShape shape =
      clump_shape(moved({{{0, 0, 0}, 1}, {{0, d, 0}, r}}, kTilt, {5, 0, 0}, 3));
  const Real larger = Cap{h}.volume(), smaller = r * r * r * Cap{(d - h) / r}.volume();
  EXPECT_NEAR(volume(shape) / 27, larger + smaller, 1e-12);
  EXPECT_NEAR(shape.shares[0], larger / (larger + smaller), 1e-13);
  EXPECT_NEAR(surface(shape) / 9, Cap{h}.surface() + r * r * Cap{(d - h) / r}.surface(), 1e-11);
}

TEST(ClumpShape, CubeOfEightThatTouch) {
  const ClumpShape shape = clump_shape(named_clump("cube"));
  EXPECT_NEAR(volume(shape), 8 * sphere_volume(1), 1e-11);
  expect_near(inertia(shape), {2.4, 2.4, 2.4}, 1e-12);
  EXPECT_NEAR(surface(shape), 32 * kPi, 1e-10);
  expect_near(std::pow(shape.diameter, 2) * shape.projected_areas, {4 * kPi, 4 * kPi, 4 * kPi},
              1e-12);
  for (const Real share : shape.shares) EXPECT_NEAR(share, 0.125, 1e-13);
}

TEST(ClumpShape, TetrahedronOfFourThatTouch) {
  const ClumpShape shape = clump_shape(named_clump("tetrahedron"));
  EXPECT_NEAR(volume(shape), 4 * sphere_volume(1), 1e-11);
  expect_near(inertia(shape), {1.4, 1.4, 1.4}, 1e-12);  // 2/5 + 2/3 of the square of sqrt(3/2)
  EXPECT_NEAR(surface(shape), 16 * kPi, 1e-10);
}

// As all radii grow by a little, the volume grows by the surface times that. Where three and four
// spheres overlap, this compares arcs with cells.
TEST(ClumpShape, SurfaceIsTheGrowthOfTheVolume) {
  for (const std::string_view name : {"dimer", "sand"}) {
    const auto grown = [&](Real by) {
      Spheres spheres = named_clump(name);
      for (ClumpSphere& sphere : spheres) sphere.radius += by;
      return volume(clump_shape(spheres));
    };
    const Real h = 1e-3, fine = (grown(h / 2) - grown(-h / 2)) / h;
    const Real coarse = (grown(h) - grown(-h)) / (2 * h), limit = fine + (fine - coarse) / 3;
    EXPECT_NEAR(limit / surface(clump_shape(named_clump(name))), 1, 1e-9) << name;
  }
}

// The slices of a rotated clump are others. What they have in common is the answer.
TEST(ClumpShape, DoesNotHangOnTheDirectionOfSlices) {
  for (const std::string_view name : kNamedClumps) {
    const Spheres spheres = named_clump(name);
    const ClumpShape shape = clump_shape(spheres);
    for (int n = 1; n < 6; ++n) {
      const Quaternion q = rotation_about({0.6, 0, 0.8}, n);
      const ClumpShape same = clump_shape(moved(spheres, q, {100. * n, -3, 7}, 0.01 * n));
      EXPECT_NEAR(same.diameter / (0.01 * n * shape.diameter), 1, 1e-11) << name;
      expect_near(same.inertia, shape.inertia, 1e-11);
      EXPECT_NEAR(same.surface, shape.surface, 1e-10) << name;
      for (std::size_t i = 0; i < spheres.size(); ++i)
        EXPECT_NEAR(same.shares[i], shape.shares[i], 1e-11) << name;
    }
  }
}

TEST(ClumpShape, ConvergesExponentially) {
  const Spheres spheres = named_clump("sand");
  const ClumpShape exact = clump_shape(spheres, 60);
  const auto error = [&](const ClumpShape& shape) {
    Real sum = std::abs(volume(shape) / volume(exact) - 1) + norm(shape.inertia - exact.inertia);
    for (std::size_t i = 0; i < spheres.size(); ++i)
      sum += std::abs(shape.shares[i] - exact.shares[i]);
    return sum;
  };
  const auto of_surface = [&](const ClumpShape& s) { return std::abs(s.surface - exact.surface); };
  Real before = 1, before_of_surface = 1;
  for (const int nodes : {4, 8, 12, 16}) {
    const ClumpShape shape = clump_shape(spheres, nodes);
    EXPECT_LT(error(shape), std::max(before / 50, 1e-12)) << nodes;
    EXPECT_LT(of_surface(shape), std::max(before_of_surface / 5, 1e-11)) << nodes;
    before = error(shape), before_of_surface = of_surface(shape);
  }
  EXPECT_LT(error(clump_shape(spheres)), 1e-12);
  EXPECT_LT(of_surface(clump_shape(spheres)), 1e-11);
}

// What the recipe of "sand" aims at; a clump of 14 spheres gets near it.
TEST(ClumpShape, SandHasTheFormOfSand) {
  const ClumpShape shape = clump_shape(named_clump("sand"));
  EXPECT_NEAR(shape.sphericity(), 0.85, 0.005);
  const auto extent = [&](Real Vec3::*k) {
    Real low = 0, high = 0;
    for (const auto& [c, r] : shape.spheres)
      low = std::min(low, c.*k - r), high = std::max(high, c.*k + r);
    return high - low;
  };
  const Real l = extent(&Vec3::x), i = extent(&Vec3::y), s = extent(&Vec3::z);
  EXPECT_NEAR(s / std::sqrt(l * i), 0.7, 0.01);
  EXPECT_NEAR(i / l, 0.788, 0.025);
  EXPECT_NEAR(s / i, 0.788, 0.025);
}

TEST(ClumpShape, SharesAddUp) {
  for (const std::string_view name : kNamedClumps) {
    const std::vector<Real> shares = clump_shape(named_clump(name)).shares;
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.), 1, 1e-14) << name;
    for (const Real share : shares) EXPECT_GT(share, 0) << name;
  }
}

// The shape of a shape is itself, and its frame leads back to the spheres that were given.
TEST(ClumpShape, IsInItsPrincipalFrame) {
  for (const std::string_view name : kNamedClumps) {
    const Spheres spheres = moved(named_clump(name), kTilt, {3, -2, 1}, 0.3);
    const ClumpShape shape = clump_shape(spheres), same = clump_shape(shape.spheres);
    EXPECT_NEAR(same.diameter, 1, 1e-12) << name;
    expect_near(same.centre, {}, 1e-12);
    expect_near(same.inertia, shape.inertia, 1e-12);
    EXPECT_NEAR(std::abs(same.principal_axes.w), 1, 1e-12) << name;
    EXPECT_LE(shape.inertia.x, shape.inertia.y + 1e-12) << name;
    EXPECT_LE(shape.inertia.y, shape.inertia.z + 1e-12) << name;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const Vec3 back = shape.diameter * rotate(shape.principal_axes, shape.spheres[i].centre);
      expect_near(shape.centre + back, spheres[i].centre, 1e-12);
      EXPECT_LE(norm(shape.spheres[i].centre) + shape.spheres[i].radius,
                shape.bounding_radius + 1e-14);
    }
  }
}

// The mean shadow of a convex body is a quarter of its surface (Cauchy). Hollows add surface and no
// shadow. No body has a smaller one than the sphere of its volume.
TEST(ClumpShape, MeanShadowIsBelowAQuarterOfTheSurface) {
  for (const std::string_view name : kNamedClumps) {
    const ClumpShape shape = clump_shape(named_clump(name));
    Real mean = 0;
    const int n = 1000;
    for (int i = 0; i < n; ++i) {  // points of a Fibonacci lattice on the sphere
      const Real z = (2 * i + 1.) / n - 1, s = std::sqrt(1 - z * z), phi = 2.399963229728653 * i;
      mean += projected_area(shape.spheres, {s * std::cos(phi), s * std::sin(phi), z}) / n;
    }
    EXPECT_GT(mean, kPi / 4) << name;
    EXPECT_LT(mean, shape.surface / 4) << name;
  }
}

TEST(ClumpShape, RefusesWhatIsNoClump) {
  const auto problem = [](const Spheres& spheres) {
    const std::string text = make_clump(spheres).problem;
    EXPECT_THROW((void)clump_shape(spheres), std::runtime_error) << text;
    return text;
  };
  EXPECT_EQ(problem({}), "a clump needs at least one sphere");
  EXPECT_EQ(problem({{{}, 1}, {{1, 0, 0}, 0}}),
            "the radius of sphere 2 of a clump is 0; it must be positive");
  EXPECT_EQ(problem({{{}, 1}, {{1, 0, 0}, -1}}),
            "the radius of sphere 2 of a clump is -1; it must be positive");
  const Real none = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_EQ(problem({{{}, none}}), "the radius of sphere 1 of a clump is nan; it must be positive");
  EXPECT_EQ(problem({{{none, 0, 0}, 1}}), "the centre of sphere 1 of a clump is no number");
  EXPECT_EQ(problem({{{}, 1}, {{2, 0, 0}, 1}, {{5, 0, 0}, 0.9}}),
            "sphere 3 of a clump touches none that is joined to sphere 1");
  EXPECT_EQ(problem({{{}, 1}, {{0.5, 0, 0}, 0.5}}),
            "sphere 2 of a clump is wholly inside sphere 1; leave it out");
  EXPECT_EQ(problem({{{}, 1}, {{}, 1}}),
            "sphere 2 of a clump is wholly inside sphere 1; leave it out");
  EXPECT_EQ(make_clump({{{}, 1}, {{2, 0, 0}, 1}, {{4, 0, 0}, 1}}).problem, "");
  // Six digits in a file are enough for spheres that touch.
  EXPECT_EQ(make_clump({{{}, 0.333333}, {{0.666667, 0, 0}, 0.333333}}).problem, "");
}

}  // namespace
}  // namespace barchan
