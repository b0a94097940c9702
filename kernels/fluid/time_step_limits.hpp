// How large an explicit fluid step may be.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Courant number dt (|u|/dx + |v|/dy + |w|/dz) of a velocity [m/s] in a cell of the given
/// spacing [m]. Central convection with Adams-Bashforth wants it below about 0.5.
KOKKOS_FORCEINLINE_FUNCTION Real courant_number(const Vec3& u, const Vec3& spacing, Real dt) {
  return dt * (Kokkos::abs(u.x) / spacing.x + Kokkos::abs(u.y) / spacing.y +
               Kokkos::abs(u.z) / spacing.z);
}

}  // namespace barchan
