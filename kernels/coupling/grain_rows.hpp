// The rows of cells that a grain lies in.
#pragma once

#include "kernels/coupling/divided_points.hpp"
#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Share of a sphere below a plane, and its first moment about the centre over the radius.
struct SphereBelow {
  Real share = 0, moment = 0;

  SphereBelow() = default;
  /// The plane lies s radii above the centre:
  ///   share = (2 + 3 s - s^3)/4, moment = -3/16 (1 - s^2)^2.
  KOKKOS_FORCEINLINE_FUNCTION explicit SphereBelow(Real s) {
    s = Kokkos::clamp(s, Real(-1), Real(1));
    const Real rest = 1 - s * s;
    share = Real(0.25) * (2 + s * (3 - s * s));
    moment = Real(-0.1875) * rest * rest;
  }
};

/// Rows of cells that share a grain: the part of its volume in each, and which of its points stand
/// for this part along x and z. The parts change with the height without jumps: grains that lie
/// side by side on a floor cross a face together. The first row is that of the centre. The lowest
/// row has also what lies in the floor, the highest what lies in the lid.
struct GrainRows {
  int n = 0;
  int row[kDividedOffsets];
  PointSet points[kDividedOffsets];  // none where the sphere reaches beyond them
  // Mean height of a row's part above its middle, over the distance to the middle of the row
  // below; the second, over the distance to that of the row above.
  Real over_lower[kDividedOffsets], over_upper[kDividedOffsets];
  PointSet outside = 0;  // points beyond the floor or the lid

  /// Finds the rows of a grain of radius r [m] whose centre has the height y [m].
  KOKKOS_INLINE_FUNCTION GrainRows(const GridRef& grid, Real y, Real r) {
    const int own = grid.row_of(y), top = grid.ny - 1;
    const bool has_floor = own == 0, has_lid = own == top;
    const Real reach = r * kOuterShell;
    if (y < reach || y + reach > grid.ly) find_outside(grid, y, r);
    const Face lower = has_floor ? Face{} : face_at(grid, own, y, r);
    const Face upper = has_lid ? whole() : face_at(grid, own + 1, y, r);
    if ((own <= 1 || y - r >= grid.y_face(own - 1)) &&
        (own >= top - 1 || y + r <= grid.y_face(own + 2))) {
      put(grid, own, y, r, lower, upper);
      put(grid, has_floor ? own : own - 1, y, r, {}, lower);
      put(grid, has_lid ? own : own + 1, y, r, upper, whole());
    } else {
      fill_many(grid, y, r, own, lower, upper);
    }
  }
  /// Share of the grain in its q-th row; the shares add up to one.
  KOKKOS_INLINE_FUNCTION Real weight(int q) const { return weight_[q]; }
  /// Mean height of the part in the q-th row [m].
  KOKKOS_INLINE_FUNCTION Real height(const GridRef& grid, int q) const {
    return grid.y_centre(row[q]) + over_lower[q] * grid.dy_centre(row[q]);
  }
  KOKKOS_INLINE_FUNCTION int find(int j) const {
    int q = 0;
    while (q + 1 < n && row[q] != j) ++q;
    return q;
  }

 private:
  // A smaller part belongs to the next row towards the centre: its mean height would be lost in
  // rounding.
  static constexpr Real kLeastPart = 1e-6;

  /// What of the grain is below a face: heights of points, sphere.
  struct Face {
    int heights = 0;
    SphereBelow below{};
  };
  KOKKOS_FORCEINLINE_FUNCTION static Face whole() {
    return {kDividedOffsets, SphereBelow(Real(1))};
  }
  KOKKOS_FORCEINLINE_FUNCTION static Face face_at(const GridRef& grid, int j, Real y, Real r) {
    const Real face = grid.y_face(j);
    Face f;
    for (int q = 0; q < kDividedOffsets; ++q)
      f.heights += y + r * divided_offset(q, false) < face ? 1 : 0;
    const SphereBelow below((face - y) / r);
    // A part that is too small is none.
    if (below.share > 1 - kLeastPart) return whole();
    if (below.share >= kLeastPart) f.below = below;
    return f;
  }
  /// Adds row j with the part between two faces, unless there is none: without a branch, whose
  /// outcome would be as good as random.
  KOKKOS_FORCEINLINE_FUNCTION void put(const GridRef& grid, int j, Real y, Real r,
                                       const Face& lower, const Face& upper) {
    static constexpr PointsBetween between = points_between();
    const Real share = upper.below.share - lower.below.share;
    const bool some = share > 0;
    const Real offset = (upper.below.moment - lower.below.moment) / (some ? share : Real(1));
    const Real above_middle = y + r * offset - grid.y_centre(j);
    row[n] = j, weight_[n] = share;
    points[n] = between.heights[lower.heights][upper.heights];
    over_lower[n] = above_middle / grid.dy_centre(j);
    over_upper[n] = above_middle / grid.dy_centre(j + 1);
    n += some ? 1 : 0;
  }
  /// Fills in a grain that reaches beyond the rows next to its own, from the middle outwards. The
  /// last rows for which there is room have all that is left.
  KOKKOS_INLINE_FUNCTION void fill_many(const GridRef& grid, Real y, Real r, int own, Face lower,
                                        Face upper) {
    constexpr int most = kDividedOffsets / 2;  // on either side
    put(grid, own, y, r, lower, upper);
    for (int j = own - 1; j >= 0 && lower.below.share > 0; --j) {
      const Face next = j == 0 || j == own - most ? Face{} : face_at(grid, j, y, r);
      put(grid, j, y, r, next, lower);
      lower = next;
    }
    for (int j = own + 1; j < grid.ny && upper.below.share < 1; ++j) {
      const Face next = j == grid.ny - 1 || j == own + most ? whole() : face_at(grid, j + 1, y, r);
      put(grid, j, y, r, upper, next);
      upper = next;
    }
  }
  KOKKOS_INLINE_FUNCTION void find_outside(const GridRef& grid, Real y, Real r) {
    constexpr DividedSets sets = divided_sets();
    for (int q = 0; q < kDividedOffsets; ++q) {
      const Real height = y + r * divided_offset(q, false);
      if (height < 0 || height > grid.ly) outside |= sets.y[q];
    }
  }

  Real weight_[kDividedOffsets];
};

}  // namespace barchan
