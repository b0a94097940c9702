// Velocity gradient and WALE eddy viscosity.
#pragma once

#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// Tensor by rows; for a velocity gradient xy is du/dy.
struct Mat3 {
  Real xx = 0, xy = 0, xz = 0;
  Real yx = 0, yy = 0, yz = 0;
  Real zx = 0, zy = 0, zz = 0;
};

KOKKOS_FORCEINLINE_FUNCTION constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
  return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}
KOKKOS_FORCEINLINE_FUNCTION constexpr Real trace(const Mat3& a) { return a.xx + a.yy + a.zz; }

/// s : s of the symmetric part s of a.
KOKKOS_FORCEINLINE_FUNCTION constexpr Real symmetric_part_squared(const Mat3& a) {
  const Real xy = Real(0.5) * (a.xy + a.yx);
  const Real xz = Real(0.5) * (a.xz + a.zx);
  const Real yz = Real(0.5) * (a.yz + a.zy);
  return a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + 2 * (xy * xy + xz * xz + yz * yz);
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

/// Eddy viscosity [m^2/s], Nicoud & Ducros, Flow Turb. Combust. 62, 183 (1999), eq. 13:
///   nu_t = (C_w Delta)^2 (Sd:Sd)^(3/2) / ((S:S)^(5/2) + (Sd:Sd)^(5/4)),
/// S the symmetric part of the velocity gradient [1/s], Sd the symmetric traceless part of its
/// square, c_w_delta = C_w times the filter width [m]. Zero in pure shear, ~ y^3 at a wall;
/// 0/0 (no motion) is zero.
KOKKOS_FORCEINLINE_FUNCTION Real wale_viscosity(const Mat3& grad_u, Real c_w_delta) {
  const Mat3 square = grad_u * grad_u;
  const Real third = trace(square) / 3;
  Mat3 deviator = square;
  deviator.xx -= third;
  deviator.yy -= third;
  deviator.zz -= third;
  const Real ss = symmetric_part_squared(grad_u);
  const Real dd = symmetric_part_squared(deviator);
  const Real rate = ss * ss * Kokkos::sqrt(ss) + dd * Kokkos::sqrt(Kokkos::sqrt(dd));
  // The smallest normal number only matters where rate is zero, and then dd is zero, too.
  return c_w_delta * c_w_delta * dd * Kokkos::sqrt(dd) / (rate + Real(1e-300));
}

/// C_w Delta [m] of row j, Delta the cube root of a cell's volume.
struct FilterWidth {
  GridRef grid;
  Real c_w;
  Kokkos::View<Real*> c_w_delta;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int j) const {
    c_w_delta(j) = c_w * Kokkos::cbrt(grid.cell_volume(j));
  }
};

/// nu_t of the cells.
struct UpdateEddyViscosity {
  GridRef grid;
  ConstFaceRef u;  // with ghosts
  FieldRef nu_t;
  const Real* c_w_delta;  // by row: C_w times the filter width [m]

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    nu_t(i, j, k) = wale_viscosity(gradient_at_cell(grid, u, i, j, k), c_w_delta[j]);
  }
};

}  // namespace barchan
