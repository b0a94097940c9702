// Markers on the surface of a grain, and the regularised delta that joins them to the faces of the
// grid. Equations: docs/theory-resolved.md.
#pragma once

#include <numbers>

#include "kernels/fluid/grid.hpp"
#include "kernels/grains/grain.hpp"

namespace barchan {

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

/// The three points nearest to a marker along one direction, and their weights.
struct DeltaLine {
  int at[3];
  Real weight[3];
};

/// The delta of three points (Roma, Peskin & Berger 1999, equation 22) with s = x / spacing:
///   phi(s) = (1 + sqrt(1 - 3 s^2)) / 3               for |s| <= 1/2,
///            (5 - 3|s| - sqrt(1 - 3 (1 - |s|)^2)) / 6 for |s| <= 3/2, else 0.
/// The weights add up to one, their first moment to zero. Points are at whole numbers.
KOKKOS_INLINE_FUNCTION DeltaLine delta_line(Real s) {
  const Real nearest = Kokkos::floor(s + Real(0.5)), q = s - nearest;
  const Real root = Kokkos::sqrt(1 - 3 * q * q), sixth = Real(1) / 6;
  const int at = static_cast<int>(nearest);
  return {{at - 1, at, at + 1},
          {(2 - 3 * q - root) * sixth, (1 + root) * (2 * sixth), (2 + 3 * q - root) * sixth}};
}

/// The same where n points repeat.
KOKKOS_INLINE_FUNCTION DeltaLine periodic_delta_line(Real s, int n) {
  DeltaLine line = delta_line(s);
  for (int& at : line.at) at -= n * static_cast<int>(Kokkos::floor(at / Real(n)));
  return line;
}

/// The same between walls, on points [first, last]: those inside share the weight of the others.
KOKKOS_INLINE_FUNCTION DeltaLine walled_delta_line(Real s, int first, int last) {
  DeltaLine line = delta_line(s);
  Real inside = 0;
  for (int q = 0; q < 3; ++q) {
    const bool is_inside = line.at[q] >= first && line.at[q] <= last;
    if (!is_inside) line.weight[q] = 0;
    line.at[q] = Kokkos::clamp(line.at[q], first, last);
    inside += line.weight[q];
  }
  for (Real& weight : line.weight) weight = inside > 0 ? weight / inside : Real(1) / 3;
  return line;
}

/// Faces around a marker: for each direction the lines of faces and of centres. The grid is all on
/// this rank, and its rows are equally high.
struct MarkerFaces {
  DeltaLine x_face, x_centre, y_face, y_centre, z_face, z_centre;

  KOKKOS_INLINE_FUNCTION MarkerFaces(const GridRef& grid, const Vec3& x)
      : x_face(periodic_delta_line(x.x / grid.dx, grid.nx)),
        x_centre(periodic_delta_line(x.x / grid.dx - Real(0.5), grid.nx)),
        y_face(walled_delta_line(x.y / grid.dy(0), 1, grid.ny - 1)),
        y_centre(walled_delta_line(x.y / grid.dy(0) - Real(0.5), 0, grid.ny - 1)),
        z_face(periodic_delta_line(x.z / grid.dz, grid.nz)),
        z_centre(periodic_delta_line(x.z / grid.dz - Real(0.5), grid.nz)) {}

  /// Calls act(i, j, k, weight) for the faces of one direction.
  template <class Act>
  KOKKOS_FORCEINLINE_FUNCTION void each_x(const Act& act) const {
    each(x_face, y_centre, z_centre, act);
  }
  template <class Act>
  KOKKOS_FORCEINLINE_FUNCTION void each_y(const Act& act) const {
    each(x_centre, y_face, z_centre, act);
  }
  template <class Act>
  KOKKOS_FORCEINLINE_FUNCTION void each_z(const Act& act) const {
    each(x_centre, y_centre, z_face, act);
  }
  /// Mean over the faces of values on them.
  template <class X, class Y, class Z>
  KOKKOS_FORCEINLINE_FUNCTION Vec3 mean(const X& of_x, const Y& of_y, const Z& of_z) const {
    Vec3 sum;
    each_x([&](int i, int j, int k, Real w) { sum.x = fma(w, of_x(i, j, k), sum.x); });
    each_y([&](int i, int j, int k, Real w) { sum.y = fma(w, of_y(i, j, k), sum.y); });
    each_z([&](int i, int j, int k, Real w) { sum.z = fma(w, of_z(i, j, k), sum.z); });
    return sum;
  }

 private:
  template <class Act>
  KOKKOS_FORCEINLINE_FUNCTION static void each(const DeltaLine& x, const DeltaLine& y,
                                               const DeltaLine& z, const Act& act) {
    for (int c = 0; c < 3; ++c)
      for (int b = 0; b < 3; ++b) {
        const Real w = y.weight[b] * z.weight[c];
        for (int a = 0; a < 3; ++a) act(x.at[a], y.at[b], z.at[c], x.weight[a] * w);
      }
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
