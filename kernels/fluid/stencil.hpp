// Differences and averages on the staggered grid; the names carry where the result lives.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "kernels/math/mat3.hpp"

namespace barchan {

// Cell field to faces. The mean is weighted with volume, so that the sum of face value times
// face volume over all faces of one direction equals the cells' own (walls apart).
KOKKOS_FORCEINLINE_FUNCTION Real cell_to_xface(const ConstFieldRef& f, int i, int j, int k) {
  return Real(0.5) * (f(i - 1, j, k) + f(i, j, k));
}
KOKKOS_FORCEINLINE_FUNCTION Real cell_to_yface(const GridRef& grid, const ConstFieldRef& f, int i,
                                               int j, int k) {
  const Real below = grid.dy(j - 1), above = grid.dy(j);
  const Real share = 1 / (below + above);
  return (below * share) * f(i, j - 1, k) + (above * share) * f(i, j, k);
}
KOKKOS_FORCEINLINE_FUNCTION Real cell_to_zface(const ConstFieldRef& f, int i, int j, int k) {
  return Real(0.5) * (f(i, j, k - 1) + f(i, j, k));
}

// Gradient of a cell field on its faces [f/m].
KOKKOS_FORCEINLINE_FUNCTION Real ddx_at_xface(const GridRef& grid, const ConstFieldRef& f, int i,
                                              int j, int k) {
  return (f(i, j, k) - f(i - 1, j, k)) * (1 / grid.dx);
}
KOKKOS_FORCEINLINE_FUNCTION Real ddy_at_yface(const GridRef& grid, const ConstFieldRef& f, int i,
                                              int j, int k) {
  return (f(i, j, k) - f(i, j - 1, k)) * (1 / grid.dy_centre(j));
}
KOKKOS_FORCEINLINE_FUNCTION Real ddz_at_zface(const GridRef& grid, const ConstFieldRef& f, int i,
                                              int j, int k) {
  return (f(i, j, k) - f(i, j, k - 1)) * (1 / grid.dz);
}

/// Divergence of a face vector in a cell [f/m].
KOKKOS_FORCEINLINE_FUNCTION Real div_at_cell(const GridRef& grid, const ConstFaceRef& f, int i,
                                             int j, int k) {
  return (f.x(i + 1, j, k) - f.x(i, j, k)) * (1 / grid.dx) +
         (f.y(i, j + 1, k) - f.y(i, j, k)) * (1 / grid.dy(j)) +
         (f.z(i, j, k + 1) - f.z(i, j, k)) * (1 / grid.dz);
}

/// Velocity at a cell centre.
KOKKOS_FORCEINLINE_FUNCTION Vec3 velocity_at_cell(const ConstFaceRef& u, int i, int j, int k) {
  return {Real(0.5) * (u.x(i, j, k) + u.x(i + 1, j, k)),
          Real(0.5) * (u.y(i, j, k) + u.y(i, j + 1, k)),
          Real(0.5) * (u.z(i, j, k) + u.z(i, j, k + 1))};
}

/// d/dy at the middle one of three stretched points `below`, `above` apart from it; exact for
/// parabolas.
KOKKOS_FORCEINLINE_FUNCTION Real ddy_of_three(Real low, Real mid, Real high, Real below,
                                              Real above) {
  const Real share = 1 / (below + above);
  return (high - mid) * (below * share / above) + (mid - low) * (above * share / below);
}

/// Velocity gradient at a cell centre [1/s]; second order, ghosts at the walls included.
KOKKOS_FORCEINLINE_FUNCTION Mat3 gradient_at_cell(const GridRef& grid, const ConstFaceRef& u, int i,
                                                  int j, int k) {
  const Real rx = 1 / grid.dx, ry = 1 / grid.dy(j), rz = 1 / grid.dz;
  const Real below = grid.dy_centre(j), above = grid.dy_centre(j + 1);
  const auto ux = [&](int jj, int kk) { return u.x(i, jj, kk) + u.x(i + 1, jj, kk); };
  const auto vy = [&](int ii, int kk) { return u.y(ii, j, kk) + u.y(ii, j + 1, kk); };
  const auto wz = [&](int ii, int jj) { return u.z(ii, jj, k) + u.z(ii, jj, k + 1); };
  Mat3 g;
  g.xx = (u.x(i + 1, j, k) - u.x(i, j, k)) * rx;
  g.xy = Real(0.5) * ddy_of_three(ux(j - 1, k), ux(j, k), ux(j + 1, k), below, above);
  g.xz = Real(0.25) * rz * (ux(j, k + 1) - ux(j, k - 1));
  g.yx = Real(0.25) * rx * (vy(i + 1, k) - vy(i - 1, k));
  g.yy = (u.y(i, j + 1, k) - u.y(i, j, k)) * ry;
  g.yz = Real(0.25) * rz * (vy(i, k + 1) - vy(i, k - 1));
  g.zx = Real(0.25) * rx * (wz(i + 1, j) - wz(i - 1, j));
  g.zy = Real(0.5) * ddy_of_three(wz(i, j - 1), wz(i, j), wz(i, j + 1), below, above);
  g.zz = (u.z(i, j, k + 1) - u.z(i, j, k)) * rz;
  return g;
}

}  // namespace barchan
