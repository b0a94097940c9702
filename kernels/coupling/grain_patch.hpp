// Cells around a grain: all that its markers reach.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "kernels/grains/grain.hpp"

namespace barchan {

/// Box of cells of the same extent for all grains. Along x and z cells wrap; rows beyond the walls
/// are not there.
struct GrainPatch {
  GridRef grid;
  Real reach = 0;              // of the largest grain [m]
  int nx = 0, ny = 0, nz = 0;  // extent in cells

  /// Patch of grains that reach so far. Rows are equally high, `dy`.
  static GrainPatch of(const GridRef& grid, Real reach, Real dy) {
    const auto cells = [reach](Real spacing) { return static_cast<int>(2 * reach / spacing) + 3; };
    return {grid, reach, Kokkos::min(cells(grid.dx), grid.nx), cells(dy),
            Kokkos::min(cells(grid.dz), grid.nz)};
  }
  KOKKOS_FORCEINLINE_FUNCTION int rows() const { return ny * nz; }

  /// Calls act(i, j, k) for the cells of a row of the patch.
  template <class Act>
  KOKKOS_INLINE_FUNCTION void each_cell(const Vec3& centre, int row, const Act& act) const {
    const int j = GridRef::cell_along(centre.y - reach, grid.dy(0)) + row % ny;
    if (j < 0 || j >= grid.ny) return;
    const int k = wrapped(GridRef::cell_along(centre.z - reach, grid.dz) + row / ny, grid.nz);
    int i = wrapped(GridRef::cell_along(centre.x - reach, grid.dx), grid.nx);
    for (int n = 0; n < nx; ++n) {
      act(i, j, k);
      if (++i == grid.nx) i = 0;
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION static int wrapped(int i, int n) {
    i %= n;
    return i < 0 ? i + n : i;
  }
};

}  // namespace barchan
