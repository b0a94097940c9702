// The rows of cells that a grain lies in.
#pragma once

#include "kernels/coupling/divided_points.hpp"
#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Height of a point; one beyond the floor or the lid is mirrored back.
KOKKOS_INLINE_FUNCTION Real mirrored_inside(const GridRef& grid, Real y) {
  y = y < 0 ? -y : y;
  return y > grid.ly ? 2 * grid.ly - y : y;
}

/// Rows of cells that share a grain, and which of its points each holds. The first row is that of
/// its centre.
struct GrainRows {
  int n = 0;
  int row[kDividedOffsets];
  PointSet points[kDividedOffsets];
  // Mean height of a row's points above its middle, over the distance to the middle of the row
  // below; the second, over the distance to that of the row above.
  Real over_lower[kDividedOffsets], over_upper[kDividedOffsets];
  PointSet outside = 0;  // points beyond the floor or the lid

  /// Finds the rows of a grain of radius r [m] whose centre has the height y [m].
  KOKKOS_INLINE_FUNCTION GrainRows(const GridRef& grid, Real y, Real r) {
    const Real low = y - kOuterShell * r, high = y + kOuterShell * r;
    const int own = grid.row_of(mirrored_inside(grid, y));
    const int lowest = grid.row_near(low, own), highest = grid.row_near(high, own);
    if (low >= 0 && high <= grid.ly && highest - lowest < kFew) {
      in_few(grid, y, r, lowest, own, highest);
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
  /// Mean height of the points in the q-th row [m].
  KOKKOS_INLINE_FUNCTION Real height(const GridRef& grid, int q) const {
    return grid.y_centre(row[q]) + over_lower[q] * grid.dy_centre(row[q]);
  }
  KOKKOS_INLINE_FUNCTION int find(int j) const {
    int q = 0;
    while (q + 1 < n && row[q] != j) ++q;
    return q;
  }

 private:
  static constexpr int kFew = 4;

  /// Fills in a grain between floor and lid that lies in a few rows.
  KOKKOS_INLINE_FUNCTION void in_few(const GridRef& grid, Real y, Real r, int lowest, int own,
                                     int highest) {
    Real at[kDividedOffsets];
    int row_of[kDividedOffsets];
    for (int q = 0; q < kDividedOffsets; ++q) {
      at[q] = y + r * divided_offset(q, false);
      row_of[q] = lowest;
    }
    for (int j = lowest + 1; j <= highest; ++j) {
      const Real face = grid.y_face(j);
      for (int q = 0; q < kDividedOffsets; ++q) row_of[q] += at[q] >= face ? 1 : 0;
    }
    add_row(own, at, row_of);
    for (int j = lowest; j <= highest; ++j)
      if (j != own) add_row(j, at, row_of);
  }
  KOKKOS_FORCEINLINE_FUNCTION void add_row(int j, const Real (&at)[kDividedOffsets],
                                           const int (&row_of)[kDividedOffsets]) {
    constexpr DividedSets sets = divided_sets();
    PointSet set = 0;
    Real sum = 0;
    for (int q = 0; q < kDividedOffsets; ++q) {
      const bool here = row_of[q] == j;
      set |= here ? sets.y[q] : 0;
      sum += here ? Kokkos::popcount(sets.y[q]) * at[q] : 0;
    }
    if (set == 0) return;
    row[n] = j, points[n] = set, sum_[n++] = sum;
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

  Real sum_[kDividedOffsets];  // sum of the heights of the points [m]
};

}  // namespace barchan
