// Differences and averages on the staggered grid; the names carry where the result lives. And what
// follows from them alone: Courant number, convective acceleration.
#pragma once

#include "kernels/fluid/grid.hpp"

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

/// Writes the velocity at all cell centres.
struct CentreVelocity {
  ConstFaceRef u;
  FieldRef x, y, z;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const Vec3 now = velocity_at_cell(u, i, j, k);
    x(i, j, k) = now.x, y(i, j, k) = now.y, z(i, j, k) = now.z;
  }
};

/// d/dy at the middle one of three stretched points `below`, `above` apart from it; exact for
/// parabolas.
KOKKOS_FORCEINLINE_FUNCTION Real ddy_of_three(Real low, Real mid, Real high, Real below,
                                              Real above) {
  const Real share = 1 / (below + above);
  return (high - mid) * (below * share / above) + (mid - low) * (above * share / below);
}

/// Courant number dt (|u|/dx + |v|/dy + |w|/dz) of a velocity [m/s] in a cell of the given
/// spacing [m]. Central convection with Adams-Bashforth wants it below about 0.5.
KOKKOS_FORCEINLINE_FUNCTION Real courant_number(const Vec3& u, const Vec3& spacing, Real dt) {
  return dt * (Kokkos::abs(u.x) / spacing.x + Kokkos::abs(u.y) / spacing.y +
               Kokkos::abs(u.z) / spacing.z);
}

/// (u . grad) u on faces [m/s^2], not the conservative form: what a fluid element feels along its
/// path. Second order inside; ghosts carry the walls.
struct ConvectiveAcceleration {
  GridRef grid;
  ConstFaceRef u;  // with ghosts

  /// Linear in y between two rows, on y-face j.
  KOKKOS_FORCEINLINE_FUNCTION Real on_yface(Real below, Real above, int j) const {
    const Real h0 = grid.dy(j - 1), h1 = grid.dy(j);
    return (h1 * below + h0 * above) * (1 / (h0 + h1));
  }
  /// d/dy of a component that lives in the middle of row j.
  KOKKOS_FORCEINLINE_FUNCTION Real ddy_in_row(const ConstFieldRef& q, int i, int j, int k) const {
    return ddy_of_three(q(i, j - 1, k), q(i, j, k), q(i, j + 1, k), grid.dy_centre(j),
                        grid.dy_centre(j + 1));
  }
  KOKKOS_FORCEINLINE_FUNCTION Real ddx(const ConstFieldRef& q, int i, int j, int k) const {
    return (q(i + 1, j, k) - q(i - 1, j, k)) * (Real(0.5) / grid.dx);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real ddz(const ConstFieldRef& q, int i, int j, int k) const {
    return (q(i, j, k + 1) - q(i, j, k - 1)) * (Real(0.5) / grid.dz);
  }

  KOKKOS_FORCEINLINE_FUNCTION Real x(int i, int j, int k) const {
    const ConstFieldRef &v = u.y, &w = u.z;
    const Real v_here =
        Real(0.25) * (v(i - 1, j, k) + v(i, j, k) + v(i - 1, j + 1, k) + v(i, j + 1, k));
    const Real w_here =
        Real(0.25) * (w(i - 1, j, k) + w(i, j, k) + w(i - 1, j, k + 1) + w(i, j, k + 1));
    return u.x(i, j, k) * ddx(u.x, i, j, k) + v_here * ddy_in_row(u.x, i, j, k) +
           w_here * ddz(u.x, i, j, k);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real y(int i, int j, int k) const {
    const ConstFieldRef& v = u.y;
    const auto mean_u = [&](int jj) { return Real(0.5) * (u.x(i, jj, k) + u.x(i + 1, jj, k)); };
    const auto mean_w = [&](int jj) { return Real(0.5) * (u.z(i, jj, k) + u.z(i, jj, k + 1)); };
    return on_yface(mean_u(j - 1), mean_u(j), j) * ddx(v, i, j, k) +
           v(i, j, k) * ddy_of_three(v(i, j - 1, k), v(i, j, k), v(i, j + 1, k), grid.dy(j - 1),
                                     grid.dy(j)) +
           on_yface(mean_w(j - 1), mean_w(j), j) * ddz(v, i, j, k);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real z(int i, int j, int k) const {
    const ConstFieldRef &q = u.x, &v = u.y;
    const Real u_here =
        Real(0.25) * (q(i, j, k - 1) + q(i, j, k) + q(i + 1, j, k - 1) + q(i + 1, j, k));
    const Real v_here =
        Real(0.25) * (v(i, j, k - 1) + v(i, j, k) + v(i, j + 1, k - 1) + v(i, j + 1, k));
    return u_here * ddx(u.z, i, j, k) + v_here * ddy_in_row(u.z, i, j, k) +
           u.z(i, j, k) * ddz(u.z, i, j, k);
  }
};

}  // namespace barchan
