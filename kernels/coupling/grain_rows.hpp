// The rows of cells that a grain lies in.
#pragma once

#include "kernels/coupling/divided_points.hpp"
#include "kernels/fluid/grid.hpp"

namespace barchan {

/// A height; what is beyond the floor or the lid is mirrored back.
KOKKOS_INLINE_FUNCTION Real mirrored_inside(const GridRef& grid, Real y) {
  y = y < 0 ? -y : y;
  return y > grid.ly ? 2 * grid.ly - y : y;
}

/// Rows of cells that share a grain, and which of its points each holds. The first is that of its
/// centre.
struct GrainRows {
  int n = 0;
  int row[kDividedOffsets];
  PointSet points[kDividedOffsets];
  // Mean height of these points above the middle of the row, over the distance to the middle of the
  // row below; over that to the row above.
  Real over_lower[kDividedOffsets], over_upper[kDividedOffsets];
  PointSet outside = 0;  // points beyond the floor or the lid

  /// Of a grain of radius r [m] whose centre has the height y [m].
  KOKKOS_INLINE_FUNCTION GrainRows(const GridRef& grid, Real y, Real r) {
    const Real low = y - kOuterShell * r, high = y + kOuterShell * r;
    const int own = grid.row_of(mirrored_inside(grid, y));
    const int lowest = grid.row_near(low, own), highest = grid.row_near(high, own);
    if (low >= 0 && high <= grid.ly && highest - lowest <= 1) {
      in_two(grid, y, r, lowest, own == highest);
    } else {
      one_by_one(grid, y, r, own);
    }
    for (int q = 0; q < n; ++q) {
      const Real height = sum_[q] / Kokkos::popcount(points[q]) - grid.y_centre(row[q]);
      over_lower[q] = height / grid.dy_centre(row[q]);
      over_upper[q] = height / grid.dy_centre(row[q] + 1);
    }
  }
  /// Share of the grain in its q-th row; the shares add up to one.
  KOKKOS_INLINE_FUNCTION Real weight(int q) const {
    return Real(Kokkos::popcount(points[q])) / kDividedPoints;
  }
  KOKKOS_INLINE_FUNCTION int find(int j) const {
    int q = 0;
    while (q + 1 < n && row[q] != j) ++q;
    return q;
  }

 private:
  /// A grain inside, in two rows that follow one another or in one: `own_is_upper` says which.
  KOKKOS_INLINE_FUNCTION void in_two(const GridRef& grid, Real y, Real r, int lower,
                                     bool own_is_upper) {
    constexpr DividedSets sets = divided_sets();
    const Real face = grid.y_face(lower + 1);
    PointSet above = 0;
    Real sum_above = 0, sum_below = 0;
    for (int q = 0; q < kDividedOffsets; ++q) {
      const Real at = y + r * divided_offset(q, false), all = Kokkos::popcount(sets.y[q]) * at;
      const bool is_above = at >= face && lower + 1 < grid.ny;
      above |= is_above ? sets.y[q] : 0;
      sum_above += is_above ? all : 0;
      sum_below += is_above ? 0 : all;
    }
    if (own_is_upper) add(lower + 1, above, sum_above);
    add(lower, kAllPoints & ~above, sum_below);
    if (!own_is_upper) add(lower + 1, above, sum_above);
  }
  KOKKOS_INLINE_FUNCTION void one_by_one(const GridRef& grid, Real y, Real r, int own) {
    constexpr DividedSets sets = divided_sets();
    for (int q = 0; q < kDividedOffsets; ++q) {
      const Real at = y + r * divided_offset(q, false), inside = mirrored_inside(grid, at);
      if (inside != at) outside |= sets.y[q];
      add(grid.row_near(inside, own), sets.y[q], Kokkos::popcount(sets.y[q]) * inside);
    }
  }
  KOKKOS_INLINE_FUNCTION void add(int j, PointSet set, Real sum_of_heights) {
    if (set == 0) return;
    int q = 0;
    while (q < n && row[q] != j) ++q;
    if (q == n) row[n] = j, points[n] = 0, sum_[n++] = 0;
    points[q] |= set;
    sum_[q] += sum_of_heights;
  }

  Real sum_[kDividedOffsets];  // of the heights of the points [m]
};

}  // namespace barchan
