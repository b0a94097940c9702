// Markers on the surface of a grain, and the regularised delta that joins them to the faces of the
// grid. Equations: docs/theory-resolved.md.
#pragma once

#include <numbers>

#include "kernels/coupling/grain_patch.hpp"
#include "kernels/math/vec4.hpp"

namespace barchan {

inline constexpr Real kRetraction = 0.35;   // of markers into the grain [cells]
inline constexpr Real kReachOfDelta = 1.5;  // [cells]

/// Number of markers that cover a sphere of so many cells, each with the volume of a cell in a
/// shell one cell thick; Uhlmann (2005), equation A.1. `radius`: of the markers, in cells.
KOKKOS_INLINE_FUNCTION constexpr int markers_on_sphere(Real radius) {
  return static_cast<int>(std::numbers::pi_v<Real> / 3 * (12 * radius * radius + 1)) + 1;
}

/// Volume of a marker in cells: its share of that shell.
KOKKOS_FORCEINLINE_FUNCTION constexpr Real marker_volume(Real radius, int n) {
  return std::numbers::pi_v<Real> / 3 * (12 * radius * radius + 1) / n;
}

/// Direction of marker m of n: points of a spiral, evenly spread over the sphere.
KOKKOS_INLINE_FUNCTION Vec3 marker_direction(int m, int n) {
  const Real golden_angle = Real(2.399963229728653);  // pi (3 - sqrt 5)
  const Real y = 1 - (2 * m + 1) / Real(n), across = Kokkos::sqrt(1 - y * y);
  return {across * Kokkos::cos(golden_angle * m), y, across * Kokkos::sin(golden_angle * m)};
}

/// The three points nearest to a marker along one direction, from `at` on, and their weights.
struct DeltaLine {
  int at;
  Real weight[3];
};

/// The delta of three points (Roma, Peskin & Berger 1999, equation 22) with s = x / spacing:
///   phi(s) = (1 + sqrt(1 - 3 s^2)) / 3               for |s| <= 1/2,
///            (5 - 3|s| - sqrt(1 - 3 (1 - |s|)^2)) / 6 for |s| <= 3/2, else 0.
/// The weights add up to one, their first moment to zero. Points are at whole numbers.
KOKKOS_INLINE_FUNCTION DeltaLine delta_line(Real s) {
  const Real nearest = Kokkos::floor(s + Real(0.5)), q = s - nearest;
  const Real root = Kokkos::sqrt(1 - 3 * q * q), sixth = Real(1) / 6;
  return {static_cast<int>(nearest) - 1,
          {(2 - 3 * q - root) * sixth, (1 + root) * (2 * sixth), (2 + 3 * q - root) * sixth}};
}

/// The same between walls, on points [first, last]: those inside share the weight of the others.
KOKKOS_INLINE_FUNCTION DeltaLine walled_delta_line(Real s, int first, int last) {
  DeltaLine line = delta_line(s);
  if (line.at >= first && line.at + 2 <= last) return line;
  if (line.at > last || line.at + 2 < first) {  // behind the wall: the point nearest to it
    const bool above = line.at > last;
    return {above ? last : first - 2, {Real(above ? 1 : 0), 0, Real(above ? 0 : 1)}};
  }
  Real inside = 0;
  for (int q = 0; q < 3; ++q) {
    if (line.at + q < first || line.at + q > last) line.weight[q] = 0;
    inside += line.weight[q];
  }
  for (Real& weight : line.weight) weight /= inside;
  return line;
}

/// Faces around a marker in the patch of its grain: along each axis the lines of faces and of
/// centres. Rows are equally high.
struct MarkerLines {
  DeltaLine face[3], centre[3];

  KOKKOS_INLINE_FUNCTION MarkerLines(const GrainPatch& patch, const PatchCorner& from,
                                     const Vec3& x) {
    const Vec3& per_cell = patch.per_cell;
    const Real s[3] = {x.x * per_cell.x, x.y * per_cell.y, x.z * per_cell.z};
    const Real half = Real(0.5);
    for (const int axis : {0, 2}) {
      face[axis] = delta_line(s[axis] - from.face[axis]);
      centre[axis] = delta_line(s[axis] - half - from.centre[axis]);
    }
    const int last = patch.grid.ny - 1;
    face[1] = walled_delta_line(s[1] - from.face[1], 1 - from.face[1], last - from.face[1]);
    centre[1] =
        walled_delta_line(s[1] - half - from.centre[1], -from.centre[1], last - from.centre[1]);
  }

  /// Mean of the values of a patch around the marker.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 mean(const GrainPatch& patch, const Real* values) const {
    return {mean(patch, 0, values), mean(patch, 1, values), mean(patch, 2, values)};
  }
  /// Calls give(place in the patch, w, x) for lines of three faces of a direction; their weights
  /// are w times the three of x.
  template <class Give>
  KOKKOS_FORCEINLINE_FUNCTION void each_line(const GrainPatch& patch, int direction,
                                             const Give& give) const {
    const DeltaLine& x = line(0, direction);
    const DeltaLine& y = line(1, direction);
    const DeltaLine& z = line(2, direction);
    const int first = patch.place(direction, x.at, y.at, z.at);
    for (int c = 0; c < 3; ++c)
      for (int b = 0; b < 3; ++b)
        give(first + patch.n[0] * (b + patch.n[1] * c), y.weight[b] * z.weight[c], x);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION const DeltaLine& line(int axis, int direction) const {
    return axis == direction ? face[axis] : centre[axis];
  }
  KOKKOS_FORCEINLINE_FUNCTION Real mean(const GrainPatch& patch, int direction,
                                        const Real* values) const {
    Vec4 sum(0, 0, 0, 0);
    each_line(patch, direction,
              [&](int at, Real w, const DeltaLine&) { sum = fma(w, Vec4(values + at), sum); });
    const Real* const w = line(0, direction).weight;
    return dot(sum.vec(), {w[0], w[1], w[2]});
  }
};

/// Markers of all grains: as many on each, at the same directions. They are drawn into the grain,
/// because the delta makes it wider (Breugem 2012).
struct Markers {
  Kokkos::View<const Vec3*> direction;
  Kokkos::View<const GrainKinematics*> grains;
  Real retraction = 0;  // [m]
  int n = 0;            // on a grain

  /// Vector from the centre of a grain to one of its markers [m].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 arm(int g, int m) const {
    return (grains(g).r - retraction) * direction(m);
  }
  KOKKOS_FORCEINLINE_FUNCTION Vec3 place(int g, int m) const { return grains(g).x + arm(g, m); }
  /// Velocity of the solid there [m/s].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 velocity(int g, int m) const {
    return grains(g).u + cross(grains(g).omega, arm(g, m));
  }
};

}  // namespace barchan
