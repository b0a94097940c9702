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

/// Conductance between row j - 1 and row j for what rows exchange through a drag coefficient of
/// one, w_j (u_j - u) in each row j, u the mean over the grain: at least as stiff, sum over pairs
/// of rows a < j <= b of w_a w_b (b - a); added up over j at most kDividedOffsets^2 / 4. For rows
/// higher than a sixth of the grain: then each between its ends holds a point.
KOKKOS_INLINE_FUNCTION Real conductance_below(const GrainRows& rows, int j) {
  Real sum = 0;
  for (int a = 0; a < rows.n; ++a) {
    for (int b = 0; b < rows.n; ++b)
      if (rows.row[a] < j && j <= rows.row[b])
        sum += rows.weight(a) * rows.weight(b) * (rows.row[b] - rows.row[a]);
  }
  return sum;
}

/// Velocity along the floor in each row of a grain, x and z [m/s]: bilinear at its centre, and
/// within a row along a slope that makes no new extremum. A grain that lies in one row of a linear
/// profile sees the profile; in a bed, where the flow above is a hundred times faster than the flow
/// between the grains, no grain sees the one for the other.
struct VelocityByRow {
  const GrainRows& rows;
  Real x[kDividedOffsets], z[kDividedOffsets];
  Real mean_x = 0, mean_z = 0;  // over the grain

  KOKKOS_INLINE_FUNCTION VelocityByRow(const GrainRows& of_grain, const PointStencil& at,
                                       const ConstFaceRef& u)
      : rows(of_grain) {
    mean_x = in_rows(u.x, at.x_faces, x);
    mean_z = in_rows(u.z, at.z_faces, z);
  }

 private:
  /// Returns the mean over the grain.
  KOKKOS_INLINE_FUNCTION Real in_rows(const ConstFieldRef& f, const PlaneStencil& at,
                                      Real (&v)[kDividedOffsets]) const {
    const auto in_row = [&](int j) { return interpolate_in_row(f, at, j); };
    Real below = 0, here = 0, above = 0, mean = 0;
    for (int r = 0; r < rows.n; ++r) {
      const int j = rows.row[r], from_last = r > 0 ? j - rows.row[r - 1] : 0;
      if (from_last == 1) {
        below = here, here = above, above = in_row(j + 1);
      } else if (from_last == -1) {
        above = here, here = below, below = in_row(j - 1);
      } else {
        below = in_row(j - 1), here = in_row(j), above = in_row(j + 1);
      }
      v[r] = here + limited_slope((here - below) * rows.over_lower[r],
                                  (above - here) * rows.over_upper[r]);
      mean += rows.weight(r) * v[r];
    }
    return mean;
  }
};

/// How velocities and impulses go between a grain and the rows that it lies in.
struct ExchangeByRow {
  bool on = false;
  DepositStencil stencil;
  PeriodicBox box;
  ConstFaceRef u;

  KOKKOS_INLINE_FUNCTION VelocityByRow velocity(const GrainRows& rows,
                                                const GrainKinematics& grain) const {
    return {rows, PointStencil(stencil.grid, box, grain.x, rows.row[0]), u};
  }
};

}  // namespace barchan
