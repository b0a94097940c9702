// Trilinear interpolation from the staggered grid to a point.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Two neighbouring indices along one axis, i and i + 1, and the weight t of the second.
struct LinearStencil {
  int i = 0;
  Real t = 0;
};

/// Interpolation weights of one point in a column of this rank for each staggering. The point is
/// brought into the domain first, wrapped or held at the ends. Near a wall the ghost row takes
/// part, so the boundary condition decides the value (a no-slip velocity vanishes there).
struct PointStencil {
  LinearStencil x_face, x_centre, y_face, y_centre, z_face, z_centre;

  KOKKOS_INLINE_FUNCTION PointStencil(const GridRef& g, const PeriodicBox& box, const Vec3& point) {
    const Vec3 inside = box.wrap(point);
    const Real x = Kokkos::clamp(inside.x, Real(0), g.lx), z = inside.z;
    const Real y = Kokkos::clamp(inside.y, Real(0), g.ly);
    x_face = uniform(x / g.dx, g.i_begin, 0, g.nx - 1);
    x_centre = uniform(x / g.dx - Real(0.5), g.i_begin, -1, g.nx - 1);
    z_face = uniform(z / g.dz, g.k_begin, 0, g.nz - 1);
    z_centre = uniform(z / g.dz - Real(0.5), g.k_begin, -1, g.nz - 1);
    const int row = g.row_of(y);
    y_face = {row, (y - g.y_face(row)) / g.dy(row)};
    const int below = y < g.y_centre(row) ? row - 1 : row;
    y_centre = {below, (y - g.y_centre(below)) / g.dy_centre(below + 1)};
  }

 private:
  /// The weight is counted over the whole domain: the same bits on any number of ranks.
  KOKKOS_INLINE_FUNCTION static LinearStencil uniform(Real s, int begin, int low, int high) {
    const int i = Kokkos::clamp(static_cast<int>(Kokkos::floor(s)) - begin, low, high);
    return {i, s - (i + begin)};
  }
};

/// Value of `f` from its eight surrounding nodes; exact for linear fields.
KOKKOS_INLINE_FUNCTION Real interpolate(const ConstFieldRef& f, const LinearStencil& x,
                                        const LinearStencil& y, const LinearStencil& z) {
  const auto along_x = [&](int j, int k) {
    return (1 - x.t) * f(x.i, j, k) + x.t * f(x.i + 1, j, k);
  };
  const auto in_plane = [&](int k) {
    return (1 - y.t) * along_x(y.i, k) + y.t * along_x(y.i + 1, k);
  };
  return (1 - z.t) * in_plane(z.i) + z.t * in_plane(z.i + 1);
}

/// The same in the plane of row j, from its four nodes there.
KOKKOS_INLINE_FUNCTION Real interpolate_in_row(const ConstFieldRef& f, const LinearStencil& x,
                                               int j, const LinearStencil& z) {
  const auto along_x = [&](int k) { return (1 - x.t) * f(x.i, j, k) + x.t * f(x.i + 1, j, k); };
  return (1 - z.t) * along_x(z.i) + z.t * along_x(z.i + 1);
}

KOKKOS_INLINE_FUNCTION Real interpolate_cell(const ConstFieldRef& f, const PointStencil& s) {
  return interpolate(f, s.x_centre, s.y_centre, s.z_centre);
}
KOKKOS_INLINE_FUNCTION Vec3 interpolate_faces(const ConstFaceRef& f, const PointStencil& s) {
  return {interpolate(f.x, s.x_face, s.y_centre, s.z_centre),
          interpolate(f.y, s.x_centre, s.y_face, s.z_centre),
          interpolate(f.z, s.x_centre, s.y_centre, s.z_face)};
}

/// Curl of the interpolated field at the point; exact for linear fields, and at a wall that of the
/// ghost row.
KOKKOS_INLINE_FUNCTION Vec3 interpolate_curl(const ConstFaceRef& f, const GridRef& g,
                                             const PointStencil& s) {
  // From one node of the stencil to the next along x, y or z.
  const auto along_x = [&](const ConstFieldRef& c, const LinearStencil& y, const LinearStencil& z) {
    const int i = s.x_centre.i;
    return (interpolate(c, {i, 1}, y, z) - interpolate(c, {i, 0}, y, z)) / g.dx;
  };
  const auto along_y = [&](const ConstFieldRef& c, const LinearStencil& x, const LinearStencil& z) {
    const int j = s.y_centre.i;
    return (interpolate(c, x, {j, 1}, z) - interpolate(c, x, {j, 0}, z)) / g.dy_centre(j + 1);
  };
  const auto along_z = [&](const ConstFieldRef& c, const LinearStencil& x, const LinearStencil& y) {
    const int k = s.z_centre.i;
    return (interpolate(c, x, y, {k, 1}) - interpolate(c, x, y, {k, 0})) / g.dz;
  };
  return {along_y(f.z, s.x_centre, s.z_face) - along_z(f.y, s.x_centre, s.y_face),
          along_z(f.x, s.x_face, s.y_centre) - along_x(f.z, s.y_centre, s.z_face),
          along_x(f.y, s.y_face, s.z_centre) - along_y(f.x, s.x_face, s.z_centre)};
}

}  // namespace barchan
