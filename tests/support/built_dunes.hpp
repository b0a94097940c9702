// Dunes built of grains, whose width, length, height and horns are known.
#pragma once

#include "src/diagnostics/dune_analytics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace barchan::test {

inline constexpr double d = 2e-4;       // grain diameter [m]
inline constexpr double bin = 2.5 * d;  // the resolution that is promised [m]
inline constexpr double mm = 1e-3;      // [m]
inline const DuneDomain channel{.length_x = 0.1, .length_z = 0.05};

using Grains = std::vector<GrainSample>;

inline Grains moved(Grains grains, double dx, double dz, const DuneDomain& domain = channel) {
  for (GrainSample& grain : grains) {
    Vec3& x = grain.x;
    x += Vec3{dx, 0, dz};
    if (domain.periodic_x) x.x -= std::floor(x.x / domain.length_x) * domain.length_x;
    if (domain.periodic_z) x.z -= std::floor(x.z / domain.length_z) * domain.length_z;
  }
  return grains;
}

using Height = std::function<double(double x, double z)>;  // [m]; zero or less: no sand

/// Columns of touching grains on a square lattice that just cover the height; `x`, `z` are the
/// middle of a square of half width `half`.
inline Grains pile(double x, double z, double half, const Height& height) {
  const int n = static_cast<int>(std::ceil(half / d));
  Grains grains;
  for (int i = -n; i <= n; ++i) {
    for (int k = -n; k <= n; ++k) {
      const double h = height(i * d, k * d);
      for (int j = 0; j * d < h; ++j) grains.push_back({{x + i * d, (j + 0.5) * d, z + k * d}, d});
    }
  }
  return grains;
}

inline Grains heap(double x, double z, double radius, double top) {
  return pile(x, z, radius,
              [=](double a, double b) { return top * (1.0 - std::hypot(a, b) / radius); });
}

inline Grains operator+(Grains a, const Grains& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A disc of 10 mm radius less one of the same radius `offset` downstream, rising inwards from the
/// outline at slope 0.3 and from the lee foot at slope 0.6.
inline Height crescent(double offset) {
  return [=](double x, double z) {
    const double from_outline = 10.0 * mm - std::hypot(x, z);
    const double from_lee = std::hypot(x - offset, z) - 10.0 * mm;
    return std::min(0.3 * from_outline, 0.6 * from_lee);
  };
}

/// A slab of 5 x 20 mm with two arms of 4 mm width downstream: a crescent with blunt horns.
inline Grains slab_with_arms(double left, double right) {
  return pile(0.04, 0.025, 20.0 * mm, [=](double x, double z) {
    const bool body = std::abs(x) < 2.5 * mm && std::abs(z) < 10.0 * mm;
    const double arm = z < 0.0 ? left : right;
    const bool in_arm =
        std::abs(z) > 6.0 * mm && std::abs(z) < 10.0 * mm && x > 0.0 && x < 2.5 * mm + arm;
    return body || in_arm ? 1.0 * mm : 0.0;
  });
}

inline std::vector<DuneRecord> measure_dunes(const Grains& grains,
                                             const DuneDomain& domain = channel) {
  return find_dunes(grains, domain).records;
}
inline DuneRecord only_dune(const Grains& grains, const DuneDomain& domain = channel) {
  const std::vector<DuneRecord> rows = measure_dunes(grains, domain);
  EXPECT_EQ(rows.size(), 1u);
  return rows.empty() ? DuneRecord{} : rows.front();
}

inline void expect_same_shape(const DuneRecord& a, const DuneRecord& b, double tolerance) {
  EXPECT_EQ(a.n_grains, b.n_grains);
  EXPECT_NEAR(a.w, b.w, tolerance);
  EXPECT_NEAR(a.l, b.l, tolerance);
  EXPECT_NEAR(a.h, b.h, tolerance);
  EXPECT_NEAR(a.cy, b.cy, 1e-9);
  EXPECT_NEAR(a.horn_left, b.horn_left, tolerance);
  EXPECT_NEAR(a.horn_right, b.horn_right, tolerance);
}

}  // namespace barchan::test
