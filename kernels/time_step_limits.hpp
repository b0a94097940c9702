// How large an explicit fluid step may be.
#pragma once

#include "kernels/grid.hpp"

namespace barchan {

/// Courant number dt (|u|/dx + |v|/dy + |w|/dz) of a velocity [m/s] in a cell of the given
/// spacing [m].
KOKKOS_INLINE_FUNCTION Real courant_number(const Vec3& u, const Vec3& spacing, Real dt) {
  return dt * (Kokkos::abs(u.x) / spacing.x + Kokkos::abs(u.y) / spacing.y +
               Kokkos::abs(u.z) / spacing.z);
}

/// Viscous number 4 nu dt sum(1/h^2): the stress term's largest eigenvalue times dt.
/// Adams-Bashforth is stable for real eigenvalues up to 1.
KOKKOS_INLINE_FUNCTION Real viscous_number(Real nu, const Vec3& spacing, Real dt) {
  return 4 * nu * dt *
         (1 / (spacing.x * spacing.x) + 1 / (spacing.y * spacing.y) + 1 / (spacing.z * spacing.z));
}

}  // namespace barchan
