// Which rank has the cells around a grain.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// n cells in parts as equal as can be, the longer ones first.
struct PartOfCell {
  int n = 1, parts = 1;
  KOKKOS_FUNCTION int operator()(int i) const {
    const int size = n / parts, longer = n % parts;
    const int in_longer = longer * (size + 1);
    return i < in_longer ? i / (size + 1) : longer + (i - in_longer) / size;
  }
};

/// Ranks by pencil, x running fastest. A position beyond an end that is not periodic belongs to the
/// last pencil there.
struct PencilOwners {
  PartOfCell x, z;
  Real dx = 1, dz = 1;  // of a cell [m]
  PeriodicBox box;

  KOKKOS_FUNCTION static int cell(Real at, Real spacing, int n) {
    return Kokkos::clamp(GridRef::cell_along(at, spacing), 0, n - 1);
  }
  KOKKOS_FUNCTION int operator()(const Vec3& position) const {
    const Vec3 p = box.wrap(position);
    return x(cell(p.x, dx, x.n)) + x.parts * z(cell(p.z, dz, z.n));
  }
};

}  // namespace barchan
