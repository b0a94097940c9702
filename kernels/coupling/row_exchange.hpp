// Exchange row by row: the part of a grain in a row of cells feels the water of that row, and that
// water loses what it gave. Source and reason: docs/model.md, "Exchange of momentum".
#pragma once

#include "kernels/coupling/void_fraction.hpp"
#include "kernels/fluid/interpolation.hpp"

namespace barchan {

/// The smaller of two slopes, zero where they differ in sign (minmod; Roe 1986).
KOKKOS_FORCEINLINE_FUNCTION Real limited_slope(Real a, Real b) {
  if (a * b <= 0) return 0;
  return Kokkos::abs(a) < Kokkos::abs(b) ? a : b;
}

/// Rows of cells that share a grain: how many of its points each holds, at which mean height [m].
struct GrainRows {
  int n = 0;
  int row[kDividedOffsets];
  int points[kDividedOffsets];
  Real height[kDividedOffsets];

  KOKKOS_INLINE_FUNCTION GrainRows(const DepositStencil& stencil, const GrainKinematics& grain) {
    constexpr DividedSets sets = divided_sets();
    const int own = stencil.grid.row_of(grain.x.y);
    for (int q = 0; q < kDividedOffsets; ++q) {
      const Real y = stencil.inside(grain.x.y + grain.r * divided_offset(q, false));
      add(stencil.grid.row_near(y, own), Kokkos::popcount(sets.y[q]), y);
    }
    for (int r = 0; r < n; ++r) height[r] /= points[r];
  }
  /// Share of the grain in its r-th row; the shares add up to one.
  KOKKOS_INLINE_FUNCTION Real weight(int r) const { return Real(points[r]) / kDividedPoints; }
  KOKKOS_INLINE_FUNCTION int find(int j) const {
    int r = 0;
    while (r + 1 < n && row[r] != j) ++r;
    return r;
  }
  /// Conductance between row j - 1 and row j for what rows exchange through a drag coefficient of
  /// one, w_j (u_j - u) in each row j, u the mean over the grain: at least as stiff, sum over pairs
  /// of rows a < j <= b of w_a w_b (b - a); added up over j at most kDividedOffsets^2 / 4. For rows
  /// higher than a sixth of the grain: then each between its ends holds a point.
  KOKKOS_INLINE_FUNCTION Real conductance_below(int j) const {
    Real sum = 0;
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b)
        if (row[a] < j && j <= row[b]) sum += weight(a) * weight(b) * (row[b] - row[a]);
    }
    return sum;
  }

 private:
  KOKKOS_INLINE_FUNCTION void add(int j, int count, Real y) {
    int r = 0;
    while (r < n && row[r] != j) ++r;
    if (r == n) row[n] = j, points[n] = 0, height[n++] = 0;
    points[r] += count;
    height[r] += count * y;
  }
};

/// Velocity along the floor in each row of a grain, x and z [m/s]: bilinear at its centre, and
/// within a row along a slope that makes no new extremum. A grain that lies in one row of a linear
/// profile sees the profile; in a bed, where the flow above is a hundred times faster than the flow
/// between the grains, no grain sees the one for the other.
struct VelocityByRow {
  const GrainRows& rows;
  Real x[kDividedOffsets], z[kDividedOffsets];
  Real mean_x = 0, mean_z = 0;  // over the grain

  KOKKOS_INLINE_FUNCTION VelocityByRow(const GridRef& grid, const GrainRows& of_grain,
                                       const PointStencil& at, const ConstFaceRef& u)
      : rows(of_grain) {
    for (int r = 0; r < rows.n; ++r) {
      x[r] = in_row(grid, u.x, at.x_face, at.z_centre, r);
      z[r] = in_row(grid, u.z, at.x_centre, at.z_face, r);
      mean_x += rows.weight(r) * x[r];
      mean_z += rows.weight(r) * z[r];
    }
  }

 private:
  KOKKOS_INLINE_FUNCTION Real in_row(const GridRef& grid, const ConstFieldRef& f,
                                     const LinearStencil& along_x, const LinearStencil& along_z,
                                     int r) const {
    const int j = rows.row[r];
    const Real here = interpolate_in_row(f, along_x, j, along_z);
    const Real below = interpolate_in_row(f, along_x, j - 1, along_z);
    const Real above = interpolate_in_row(f, along_x, j + 1, along_z);
    const Real slope =
        limited_slope((here - below) / grid.dy_centre(j), (above - here) / grid.dy_centre(j + 1));
    return here + slope * (rows.height[r] - grid.y_centre(j));
  }
};

/// How velocities and impulses go between a grain and the rows that it lies in.
struct ExchangeByRow {
  bool on = false;
  DepositStencil stencil;
  PeriodicBox box;
  ConstFaceRef u;

  KOKKOS_INLINE_FUNCTION GrainRows rows_of(const GrainKinematics& grain) const {
    return {stencil, grain};
  }
  KOKKOS_INLINE_FUNCTION VelocityByRow velocity(const GrainRows& rows,
                                                const GrainKinematics& grain) const {
    return {stencil.grid, rows, PointStencil(stencil.grid, box, grain.x), u};
  }
};

}  // namespace barchan
