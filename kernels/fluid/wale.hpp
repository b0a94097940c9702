// WALE eddy viscosity.
#pragma once

#include "kernels/fluid/stencil.hpp"
#include "kernels/math/mat3.hpp"

namespace barchan {

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
