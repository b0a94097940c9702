// Convective acceleration of the flow, as grains feel it.
#pragma once

#include "kernels/fluid/stencil.hpp"

namespace barchan {

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
