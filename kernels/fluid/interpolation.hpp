// Trilinear interpolation from the staggered grid to a point.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Two neighbouring indices along one axis, i and i + 1, and the weight t of the second.
struct LinearStencil {
  int i = 0;
  Real t = 0;
};

/// Four neighbouring nodes (i or i + 1, k or k + 1) in the plane of a row of cells, and the weight
/// of each.
struct PlaneStencil {
  int i = 0, k = 0;
  Real front[2]{}, back[2]{};  // of i and i + 1 at k, at k + 1

  PlaneStencil() = default;
  KOKKOS_INLINE_FUNCTION PlaneStencil(const LinearStencil& x, const LinearStencil& z)
      : i(x.i),
        k(z.i),
        front{(1 - x.t) * (1 - z.t), x.t * (1 - z.t)},
        back{(1 - x.t) * z.t, x.t * z.t} {}
};

/// Value of `f` in the plane of row j, from its four nodes there; exact for linear fields.
KOKKOS_FORCEINLINE_FUNCTION Real interpolate_in_row(const ConstFieldRef& f, const PlaneStencil& at,
                                                    int j) {
  const Real* const near = &f(at.i, j, at.k);
  const Real* const far = near + f.stride_z;
  return fma(at.back[1], far[1],
             fma(at.back[0], far[0], fma(at.front[1], near[1], at.front[0] * near[0])));
}
/// Value of `f` from its eight surrounding nodes; exact for linear fields.
KOKKOS_FORCEINLINE_FUNCTION Real interpolate(const ConstFieldRef& f, const PlaneStencil& at,
                                             const LinearStencil& y) {
  const Real below = interpolate_in_row(f, at, y.i), above = interpolate_in_row(f, at, y.i + 1);
  return (1 - y.t) * below + y.t * above;
}
KOKKOS_INLINE_FUNCTION Real interpolate(const ConstFieldRef& f, const LinearStencil& x,
                                        const LinearStencil& y, const LinearStencil& z) {
  return interpolate(f, {x, z}, y);
}

/// Interpolation weights of a height in or near a row, at the walls held inside the domain. Near a
/// wall the ghost row takes part, so the boundary condition decides the value (a no-slip velocity
/// vanishes there).
struct HeightStencil {
  LinearStencil y_face, y_centre;

  KOKKOS_FORCEINLINE_FUNCTION HeightStencil(const GridRef& g, Real height, int row_nearby) {
    const Real y = Kokkos::clamp(height, Real(0), g.ly);
    const int row = g.row_near(y, row_nearby), below = y < g.y_centre(row) ? row - 1 : row;
    y_face = {row, (y - g.y_face(row)) / g.dy(row)};
    y_centre = {below, (y - g.y_centre(below)) / g.dy_centre(below + 1)};
  }
};

/// Interpolation weights of one point in a column of this rank for each staggering. The point is
/// brought into the domain first, wrapped or held at the ends.
struct PointStencil : HeightStencil {
  LinearStencil x_face, x_centre, z_face, z_centre;
  PlaneStencil x_faces, centres, z_faces;

  KOKKOS_INLINE_FUNCTION PointStencil(const GridRef& g, const PeriodicBox& box, const Vec3& point)
      : PointStencil(g, box, point, g.row_of(point.y)) {}
  /// Stencil of a point in or near a row.
  KOKKOS_INLINE_FUNCTION PointStencil(const GridRef& g, const PeriodicBox& box, const Vec3& point,
                                      int row_nearby)
      : HeightStencil(g, point.y, row_nearby) {
    const Vec3 inside = box.wrap(point);
    const Real x = Kokkos::clamp(inside.x, Real(0), g.lx), z = inside.z;
    x_face = uniform(x / g.dx, g.i_begin, 0, g.nx - 1);
    x_centre = uniform(x / g.dx - Real(0.5), g.i_begin, -1, g.nx - 1);
    z_face = uniform(z / g.dz, g.k_begin, 0, g.nz - 1);
    z_centre = uniform(z / g.dz - Real(0.5), g.k_begin, -1, g.nz - 1);
    x_faces = {x_face, z_centre};
    centres = {x_centre, z_centre};
    z_faces = {x_centre, z_face};
  }

 private:
  /// The weight is counted over the whole domain: the same bits on any number of ranks.
  KOKKOS_INLINE_FUNCTION static LinearStencil uniform(Real s, int begin, int low, int high) {
    const int i = Kokkos::clamp(static_cast<int>(Kokkos::floor(s)) - begin, low, high);
    return {i, s - (i + begin)};
  }
};

KOKKOS_INLINE_FUNCTION Real interpolate_cell(const ConstFieldRef& f, const PointStencil& s) {
  return interpolate(f, s.centres, s.y_centre);
}
KOKKOS_INLINE_FUNCTION Vec3 interpolate_faces(const ConstFaceRef& f, const PointStencil& s) {
  return {interpolate(f.x, s.x_faces, s.y_centre), interpolate(f.y, s.centres, s.y_face),
          interpolate(f.z, s.z_faces, s.y_centre)};
}

/// Differences of a field from one of the eight nodes around a point to the next along an axis,
/// interpolated across it; exact for linear fields.
struct NodeDifferences {
  const ConstFieldRef& f;
  const LinearStencil &x, &y, &z;

  KOKKOS_FORCEINLINE_FUNCTION Real along_x() const {
    const auto at = [this](int i, int j) {
      return fma(z.t, f(i, j, z.i + 1), (1 - z.t) * f(i, j, z.i));
    };
    return between_rows(at, x.i + 1) - between_rows(at, x.i);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real along_y(const PlaneStencil& at) const {
    return interpolate_in_row(f, at, y.i + 1) - interpolate_in_row(f, at, y.i);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real along_z() const {
    const auto at = [this](int k, int j) {
      return fma(x.t, f(x.i + 1, j, k), (1 - x.t) * f(x.i, j, k));
    };
    return between_rows(at, z.i + 1) - between_rows(at, z.i);
  }

 private:
  template <class InRow>
  KOKKOS_FORCEINLINE_FUNCTION Real between_rows(const InRow& at, int n) const {
    return (1 - y.t) * at(n, y.i) + y.t * at(n, y.i + 1);
  }
};

/// Gradient of the interpolated field of cells at the point; exact for linear fields.
KOKKOS_INLINE_FUNCTION Vec3 interpolate_gradient(const ConstFieldRef& f, const GridRef& g,
                                                 const PointStencil& s) {
  const NodeDifferences difference{f, s.x_centre, s.y_centre, s.z_centre};
  return {difference.along_x() / g.dx,
          difference.along_y(s.centres) / g.dy_centre(s.y_centre.i + 1),
          difference.along_z() / g.dz};
}

/// Curl of the interpolated field in the column of a point, at a height; exact for linear fields,
/// and at a wall that of the ghost row.
KOKKOS_FORCEINLINE_FUNCTION Vec3 interpolate_curl(const ConstFaceRef& f, const GridRef& g,
                                                  const PointStencil& s, const HeightStencil& at) {
  const NodeDifferences of_x{f.x, s.x_face, at.y_centre, s.z_centre},
      of_y{f.y, s.x_centre, at.y_face, s.z_centre}, of_z{f.z, s.x_centre, at.y_centre, s.z_face};
  const Real per_x = 1 / g.dx, per_y = 1 / g.dy_centre(at.y_centre.i + 1), per_z = 1 / g.dz;
  return {of_z.along_y(s.z_faces) * per_y - of_y.along_z() * per_z,
          of_x.along_z() * per_z - of_z.along_x() * per_x,
          of_y.along_x() * per_x - of_x.along_y(s.x_faces) * per_y};
}
KOKKOS_INLINE_FUNCTION Vec3 interpolate_curl(const ConstFaceRef& f, const GridRef& g,
                                             const PointStencil& s) {
  return interpolate_curl(f, g, s, s);
}

}  // namespace barchan
