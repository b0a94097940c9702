// Ranks that own the cells around a grain.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "kernels/math/block_partition.hpp"

namespace barchan {

/// Ranks by pencil, x running fastest. A position beyond an end that is not periodic belongs to the
/// last pencil there.
struct PencilOwners {
  BlockPartition x, z;  // parts of the cells along x and z
  Real dx = 1, dz = 1;  // size of a cell [m]
  PeriodicBox box;

  KOKKOS_FUNCTION static int cell(Real at, Real spacing, int n) {
    return Kokkos::clamp(GridRef::cell_along(at, spacing), 0, n - 1);
  }
  KOKKOS_FUNCTION int operator()(const Vec3& position) const {
    const Vec3 p = box.wrap(position);
    return x.part_of(cell(p.x, dx, x.n)) + x.parts * z.part_of(cell(p.z, dz, z.n));
  }
};

}  // namespace barchan
