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
    if (low >= grid.y_face(Kokkos::max(own - 1, 0)) &&
        high < grid.y_face(Kokkos::min(own + 2, grid.ny))) {
      const int lower = heights_below(grid.y_face(own), y, r);
      const int upper = heights_below(grid.y_face(own + 1), y, r);
      put(grid, own, y, r, lower, upper);
      put(grid, Kokkos::max(own - 1, 0), y, r, 0, lower);
      put(grid, Kokkos::min(own + 1, grid.ny - 1), y, r, upper, kDividedOffsets);
    } else {
      one_by_one(grid, y, r, own);
    }
  }
  /// Share of the grain in its q-th row; the shares add up to one.
  KOKKOS_INLINE_FUNCTION Real weight(int q) const { return weight_[q]; }
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
  /// Number of the heights of points that are below a face.
  KOKKOS_FORCEINLINE_FUNCTION static int heights_below(Real face, Real y, Real r) {
    int number = 0;
    for (int q = 0; q < kDividedOffsets; ++q)
      number += y + r * divided_offset(q, false) < face ? 1 : 0;
    return number;
  }
  /// Adds row j with the points at the heights [first, last), unless there are none: without a
  /// branch, whose outcome would be as good as random.
  KOKKOS_FORCEINLINE_FUNCTION void put(const GridRef& grid, int j, Real y, Real r, int first,
                                       int last) {
    static constexpr PointsBetween between = points_between();
    const PointsBetween::Points& points_of_row = between.heights[first][last];
    points[n] = points_of_row.set;
    set(grid, n, j, points_of_row.weight, y + r * points_of_row.mean_offset);
    n += points_of_row.set != 0 ? 1 : 0;
  }
  KOKKOS_FORCEINLINE_FUNCTION void set(const GridRef& grid, int q, int j, Real weight,
                                       Real height) {
    const Real above_middle = height - grid.y_centre(j);
    row[q] = j, weight_[q] = weight;
    over_lower[q] = above_middle / grid.dy_centre(j);
    over_upper[q] = above_middle / grid.dy_centre(j + 1);
  }
  /// Fills in any grain. Points beyond the floor or the lid are mirrored back.
  KOKKOS_INLINE_FUNCTION void one_by_one(const GridRef& grid, Real y, Real r, int own) {
    constexpr DividedSets sets = divided_sets();
    Real sum[kDividedOffsets];  // of the heights of a row's points [m]
    for (int at = 0; at < kDividedOffsets; ++at) {
      const Real height = y + r * divided_offset(at, false);
      const Real inside = mirrored_inside(grid, height);
      if (inside != height) outside |= sets.y[at];
      const int j = grid.row_near(inside, own);
      int q = 0;
      while (q < n && row[q] != j) ++q;
      if (q == n) row[n] = j, points[n] = 0, sum[n++] = 0;
      points[q] |= sets.y[at];
      sum[q] += Kokkos::popcount(sets.y[at]) * inside;
    }
    for (int q = 0; q < n; ++q) {
      const int count = Kokkos::popcount(points[q]);
      set(grid, q, row[q], Real(count) / kDividedPoints, sum[q] / count);
    }
  }

  Real weight_[kDividedOffsets];  // share of the grain in each row
};

}  // namespace barchan
