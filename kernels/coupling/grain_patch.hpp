// Faces around a grain, in memory of its own.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "kernels/grains/grain.hpp"

namespace barchan {

/// Index along an axis among the cells of all ranks, not wrapped, of the first faces of a patch and
/// of the first centres of cells.
struct PatchCorner {
  int face[3], centre[3];
  /// Of the faces of a direction: they lie between cells along it, across it in their middle.
  KOKKOS_FORCEINLINE_FUNCTION int of(int axis, int direction) const {
    return axis == direction ? face[axis] : centre[axis];
  }
};

/// Boxes of faces around grains, of the same extent for all: one for each direction of faces. They
/// go on behind the walls and over the ends of a period, so that neighbours lie side by side.
struct GrainPatch {
  GridRef grid;
  Vec3 per_cell;         // one over the size of a cell [1/m]
  Vec3 reach;            // from the centre of the largest grain [cells]
  int n[3] = {0, 0, 0};  // faces along x, y, z
  int first_y_face = 0;  // first row of faces along y that counts

  /// Patch that holds all points nearer to a centre than `reach` [m] and so many cells more. Rows
  /// are equally high, `dy`.
  static GrainPatch of(const GridRef& grid, Real reach, Real cells, Real dy) {
    const Real more = cells + Real(1e-9);  // for rounding
    const Vec3 per_cell{1 / grid.dx, 1 / dy, 1 / grid.dz};
    const Vec3 all = reach * per_cell + Vec3{more, more, more};
    const auto points = [](Real along) { return static_cast<int>(2 * along) + 1; };
    return {grid, per_cell, all, {points(all.x), points(all.y), points(all.z)}, 0};
  }

  KOKKOS_FORCEINLINE_FUNCTION int rows() const { return 3 * n[1] * n[2]; }
  /// Numbers of a patch, with a few behind the last: vectors of four read and write them.
  KOKKOS_FORCEINLINE_FUNCTION int size() const { return n[0] * rows() + 8; }
  KOKKOS_FORCEINLINE_FUNCTION int place(int direction, int a, int b, int c) const {
    return a + n[0] * (b + n[1] * (c + n[2] * direction));
  }

  KOKKOS_INLINE_FUNCTION PatchCorner corner(const Vec3& x) const {
    const auto beyond = [](Real s) { return static_cast<int>(Kokkos::floor(s)) + 1; };
    // Where a grain is behind a wall, its patch still has a row inside.
    const auto row = [&](Real s, int first) {
      return Kokkos::clamp(beyond(s), first + 1 - n[1], grid.ny - 1);
    };
    const Real half = Real(0.5);
    const Vec3 s{x.x * per_cell.x - reach.x, x.y * per_cell.y - reach.y,
                 x.z * per_cell.z - reach.z};
    return {{beyond(s.x), row(s.y, 1), beyond(s.z)},
            {beyond(s.x - half), row(s.y - half, 0), beyond(s.z - half)}};
  }

  /// Calls act(place in the patch, i, j, k, n) for runs of n faces that this rank owns, in row
  /// (b, c) of the faces of a direction.
  template <class Act>
  KOKKOS_INLINE_FUNCTION void each_run(const PatchCorner& from, int direction, int b, int c,
                                       const Act& act) const {
    const int j = from.of(1, direction) + b;
    if (j < (direction == 1 ? first_y_face : 0) || j >= grid.ny) return;
    const int k = here(from.of(2, direction) + c, grid.k_begin, grid.nz_all);
    if (k >= grid.nz) return;
    int a = 0, i = here(from.of(0, direction), grid.i_begin, grid.nx_all);
    while (a < n[0]) {
      const int end = i < grid.nx ? grid.nx : grid.nx_all;
      const int run = Kokkos::min(n[0] - a, end - i);
      if (i < grid.nx) act(place(direction, a, b, c), i, j, k, run);
      a += run, i = end == grid.nx_all ? 0 : end;
    }
  }
  /// The same for a row of all directions.
  template <class Act>
  KOKKOS_INLINE_FUNCTION void each_run(const PatchCorner& from, int row, const Act& act) const {
    each_run(from, row / (n[1] * n[2]), row % n[1], row / n[1] % n[2], act);
  }
  /// First index along z in a patch of the plane k of this rank; from n[2] on there is none.
  KOKKOS_FORCEINLINE_FUNCTION int plane(const PatchCorner& from, int direction, int k) const {
    return here(grid.k_begin + k, from.of(2, direction), grid.nz_all);
  }

 private:
  /// Index of a cell from the first of this rank on, from 0 to n - 1.
  KOKKOS_FORCEINLINE_FUNCTION static int here(int cell, int first, int n) {
    const int i = (cell - first) % n;
    return i < 0 ? i + n : i;
  }
};

}  // namespace barchan
