// The points that stand for the volume of a grain.
#pragma once

#include <cstdint>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// 29 points of equal volume: the centre and two shells of 14 (6 on the axes, 8 at polar angles of
/// 45 and 135 degrees), at the volume-weighted mean radii of the shells bounded by cbrt(1/29),
/// cbrt(15/29) and 1 of the grain radius: r = (3/4)(b^4 - a^4)/(b^3 - a^3). The points of CFDEM's
/// "divided" model (Lima et al. 2022, Sec. IV).
inline constexpr int kDividedPoints = 29;
inline constexpr Real kInnerShell = 0.6276;  // fractions of the radius
inline constexpr Real kOuterShell = 0.9085;

/// The coordinates that the points have along x, y and z in units of the grain radius, nine of
/// each: zero; of either shell, its end and what its corners have, up and down. The corners lie at
/// a polar angle from z with sin = cos = 1/sqrt 2 and at azimuths of 45 + 90 n degrees.
inline constexpr int kDividedOffsets = 9;
KOKKOS_INLINE_FUNCTION constexpr Real divided_offset(int q, bool along_z) {
  if (q == 0) return 0;
  const Real shell = q <= 4 ? kInnerShell : kOuterShell;
  const Real of_corner = along_z ? Real(0.70710678118654752) : Real(0.5);
  const Real size = (q - 1) % 4 < 2 ? shell : of_corner * shell;
  return q % 2 == 1 ? size : -size;
}
/// Index of a point's coordinate along each axis.
struct DividedAxes {
  int x = 0, y = 0, z = 0;
};
KOKKOS_INLINE_FUNCTION constexpr DividedAxes divided_axes(int p) {
  if (p == 0) return {};
  const int shell = p <= 14 ? 1 : 5, q = (p - 1) % 14;
  if (q < 6) {
    const int end = shell + q % 2;
    return {q / 2 == 0 ? end : 0, q / 2 == 1 ? end : 0, q / 2 == 2 ? end : 0};
  }
  const int corner = q - 6;
  return {shell + 2 + (corner & 1), shell + 2 + (corner >> 1 & 1), shell + 2 + (corner >> 2 & 1)};
}
/// Offset of point p from the centre in units of the grain radius.
KOKKOS_INLINE_FUNCTION constexpr Vec3 divided_point(int p) {
  const DividedAxes at = divided_axes(p);
  return {divided_offset(at.x, false), divided_offset(at.y, false), divided_offset(at.z, true)};
}

/// A set of points, a bit each.
using PointSet = std::uint32_t;
inline constexpr PointSet kAllPoints = (PointSet{1} << kDividedPoints) - 1, kCentrePoint = 1;

/// The points with the q-th coordinate along each axis.
struct DividedSets {
  PointSet x[kDividedOffsets]{}, y[kDividedOffsets]{}, z[kDividedOffsets]{};
};
KOKKOS_INLINE_FUNCTION constexpr DividedSets divided_sets() {
  DividedSets sets;
  for (int p = 0; p < kDividedPoints; ++p) {
    const DividedAxes at = divided_axes(p);
    const PointSet point = PointSet{1} << p;
    sets.x[at.x] |= point, sets.y[at.y] |= point, sets.z[at.z] |= point;
  }
  return sets;
}

/// The points at the heights [first, last), counted upwards.
struct PointsBetween {
  PointSet heights[kDividedOffsets + 1][kDividedOffsets + 1]{};  // by first and last
};
KOKKOS_INLINE_FUNCTION constexpr PointsBetween points_between() {
  constexpr int upwards[kDividedOffsets] = {6, 2, 8, 4, 0, 3, 7, 1, 5};  // of divided_offset
  const DividedSets sets = divided_sets();
  PointsBetween between;
  for (int first = 0; first < kDividedOffsets; ++first) {
    for (int last = first; last < kDividedOffsets; ++last)
      between.heights[first][last + 1] = between.heights[first][last] | sets.y[upwards[last]];
  }
  return between;
}

}  // namespace barchan
