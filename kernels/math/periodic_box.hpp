// The periodic directions of the domain: positions in it and separations between them.
#pragma once

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Periodic extents [m], the corner at the origin; zero where a direction is not periodic.
struct PeriodicBox {
  Real lx = 0, lz = 0;

  /// Image of a position inside the box, from 0 to lx and 0 to lz.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 wrap(Vec3 x) const {
    if (lx > 0) x.x -= lx * Kokkos::floor(x.x / lx);
    if (lz > 0) x.z -= lz * Kokkos::floor(x.z / lz);
    return x;
  }
  /// Nearest image of a separation between two positions inside the box.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 nearest_image(Vec3 s) const {
    s.x -= s.x > lx / 2 ? lx : Real(0);
    s.x += s.x < -lx / 2 ? lx : Real(0);
    s.z -= s.z > lz / 2 ? lz : Real(0);
    s.z += s.z < -lz / 2 ? lz : Real(0);
    return s;
  }
};

}  // namespace barchan
