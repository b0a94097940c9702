// Where a grain's volume lies on the grid: the divided void fraction, and deposits that add up to
// the same bits in any order.
#pragma once

#include <cstdint>

#include "kernels/fluid/grid.hpp"
#include "kernels/grains/grain.hpp"

namespace barchan {

/// 29 points of equal volume: the centre and two shells of 14 (6 on the axes, 8 at polar angles of
/// 45 and 135 degrees), at the volume-weighted mean radii of the shells bounded by cbrt(1/29),
/// cbrt(15/29) and 1 of the grain radius: r = (3/4)(b^4 - a^4)/(b^3 - a^3). The points of CFDEM's
/// "divided" model (Lima et al. 2022, Sec. IV).
inline constexpr int kDividedPoints = 29;
inline constexpr Real kInnerShell = 0.6276;  // fractions of the radius
inline constexpr Real kOuterShell = 0.9085;

/// The coordinates that the points have along x, y and z in units of the grain radius, nine of
/// each: zero; of either shell, its end and what its corners have, up and down. The corners lie at
/// a polar angle from z with sin = cos = 1/sqrt 2 and at azimuths of 45 + 90 n degrees.
inline constexpr int kDividedOffsets = 9;
KOKKOS_INLINE_FUNCTION constexpr Real divided_offset(int q, bool along_z) {
  if (q == 0) return 0;
  const Real shell = q <= 4 ? kInnerShell : kOuterShell;
  const Real of_corner = along_z ? Real(0.70710678118654752) : Real(0.5);
  const Real size = (q - 1) % 4 < 2 ? shell : of_corner * shell;
  return q % 2 == 1 ? size : -size;
}
/// Which of them point p has.
struct DividedAxes {
  int x = 0, y = 0, z = 0;
};
KOKKOS_INLINE_FUNCTION constexpr DividedAxes divided_axes(int p) {
  if (p == 0) return {};
  const int shell = p <= 14 ? 1 : 5, q = (p - 1) % 14;
  if (q < 6) {
    const int end = shell + q % 2;
    return {q / 2 == 0 ? end : 0, q / 2 == 1 ? end : 0, q / 2 == 2 ? end : 0};
  }
  const int corner = q - 6;
  return {shell + 2 + (corner & 1), shell + 2 + (corner >> 1 & 1), shell + 2 + (corner >> 2 & 1)};
}
/// Offset of point p from the centre in units of the grain radius.
KOKKOS_INLINE_FUNCTION constexpr Vec3 divided_point(int p) {
  const DividedAxes at = divided_axes(p);
  return {divided_offset(at.x, false), divided_offset(at.y, false), divided_offset(at.z, true)};
}

/// A set of points, a bit each.
using PointSet = std::uint32_t;
inline constexpr PointSet kAllPoints = (PointSet{1} << kDividedPoints) - 1;

/// The points with the q-th coordinate along each axis.
struct DividedSets {
  PointSet x[kDividedOffsets]{}, y[kDividedOffsets]{}, z[kDividedOffsets]{};
};
KOKKOS_INLINE_FUNCTION constexpr DividedSets divided_sets() {
  DividedSets sets;
  for (int p = 0; p < kDividedPoints; ++p) {
    const DividedAxes at = divided_axes(p);
    const PointSet point = PointSet{1} << p;
    sets.x[at.x] |= point, sets.y[at.y] |= point, sets.z[at.z] |= point;
  }
  return sets;
}

/// Columns or rows of cells along one direction that share a grain, and which points each holds.
struct PointsAlong {
  int n = 0;
  int cell[kDividedOffsets];
  PointSet points[kDividedOffsets];

  KOKKOS_INLINE_FUNCTION void add(int c, PointSet set) {
    int q = 0;
    while (q < n && cell[q] != c) ++q;
    if (q == n) cell[n] = c, points[n++] = 0;
    points[q] |= set;
  }
};

/// Indices of a cell, owned or a ghost beside an owned one. Not set by default: GrainCells has
/// many.
struct CellIndex {
  int i, j, k;
  /// Its number among the owned cells and the ghosts around them in x and z.
  KOKKOS_INLINE_FUNCTION std::int64_t linear(const GridRef& grid) const {
    return i + 1 + std::int64_t{grid.nx + 2} * (j + std::int64_t{grid.ny} * (k + 1));
  }
  static std::size_t count(const GridRef& grid) {
    return static_cast<std::size_t>(grid.nx + 2) * static_cast<std::size_t>(grid.ny) *
           static_cast<std::size_t>(grid.nz + 2);
  }
  KOKKOS_INLINE_FUNCTION bool operator==(const CellIndex& b) const {
    return i == b.i && j == b.j && k == b.k;
  }
};

/// Cells that share a grain, and how many of its points each holds.
struct GrainCells {
  int n = 0, n_points = 0;
  CellIndex cell[kDividedPoints];
  int count[kDividedPoints];

  /// A cell that is not there yet, unless it holds no point.
  KOKKOS_INLINE_FUNCTION void put(const CellIndex& c, int points) {
    if (points == 0) return;
    n_points += points;
    cell[n] = c;
    count[n++] = points;
  }
  KOKKOS_INLINE_FUNCTION void add(const CellIndex& c, int points) {
    for (int q = 0; q < n; ++q) {
      if (cell[q] == c) {
        n_points += points;
        count[q] += points;
        return;
      }
    }
    put(c, points);
  }
  /// Share of the grain in its q-th cell; the shares add up to one.
  KOKKOS_INLINE_FUNCTION Real weight(int q) const { return Real(count[q]) / Real(n_points); }
};

/// `cfdem`: a point outside gives its share to the grain's own cell, as CFDEM does.
enum class PointModel { divided, centre, cfdem };

/// Finds the cells of a grain. No volume is lost: a point beyond a wall is mirrored back, one
/// beyond the outlet goes to the last cell, periodic directions wrap. Where the grid is cut among
/// ranks, points of a grain inside may lie in the ghosts of the neighbours' cells.
struct DepositStencil {
  GridRef grid;
  PointModel points = PointModel::divided;
  PeriodicBox box;            // directions that are periodic and not cut
  int i_low = 0, i_high = 0;  // a point beyond belongs to these
  int k_low = 0, k_high = 0;

  /// Index from 0 to n - 1 along a periodic direction, of one that is rarely a period off.
  KOKKOS_INLINE_FUNCTION static int wrap(int i, int n) {
    if (i >= 0 && i < n) return i;
    if (i >= -n && i < 2 * n) return i < 0 ? i + n : i - n;
    return ((i % n) + n) % n;
  }
  KOKKOS_INLINE_FUNCTION int column_x(Real x) const {
    return grid.cell_along(x, grid.dx) - grid.i_begin;
  }
  KOKKOS_INLINE_FUNCTION int column_z(Real z) const {
    return grid.cell_along(z, grid.dz) - grid.k_begin;
  }
  /// A height; what is beyond a wall is mirrored back.
  KOKKOS_INLINE_FUNCTION Real inside(Real y) const {
    y = y < 0 ? -y : y;
    return y > grid.ly ? 2 * grid.ly - y : y;
  }
  /// Row of a height near a row.
  KOKKOS_INLINE_FUNCTION int row_of(Real y, int row_nearby) const {
    return grid.row_near(inside(y), row_nearby);
  }
  KOKKOS_INLINE_FUNCTION int cell_x(Real x) const {
    const int i = column_x(x);
    return Kokkos::clamp(box.lx > 0 ? wrap(i, grid.nx) : i, i_low, i_high);
  }
  KOKKOS_INLINE_FUNCTION int cell_z(Real z) const {
    const int k = column_z(z);
    return Kokkos::clamp(box.lz > 0 ? wrap(k, grid.nz) : k, k_low, k_high);
  }
  /// The cell that holds a point not far from a row.
  KOKKOS_INLINE_FUNCTION CellIndex cell_of(const Vec3& p, int row_nearby) const {
    return {cell_x(p.x), row_of(p.y, row_nearby), cell_z(p.z)};
  }
  KOKKOS_INLINE_FUNCTION bool is_outside(Real y) const { return y < 0 || y > grid.ly; }

  KOKKOS_INLINE_FUNCTION GrainCells operator()(const GrainKinematics& g) const {
    GrainCells cells;
    const Vec3 x = box.wrap(g.x);
    const int row = grid.row_of(x.y);
    const CellIndex own = cell_of(x, row);
    if (points == PointModel::centre) {
      cells.put(own, 1);
      return cells;
    }
    PointSet to_own = 0;
    const PointsAlong rows = rows_of_points(x.y, g.r, row, to_own);
    const PointsAlong along_x = columns_of_points<false>(x.x, g.r, own.i);
    const PointsAlong along_z = columns_of_points<true>(x.z, g.r, own.k);
    for (int b = 0; b < rows.n; ++b) {
      for (int a = 0; a < along_x.n; ++a) {
        const PointSet set = rows.points[b] & along_x.points[a];
        for (int c = 0; c < along_z.n; ++c)
          cells.put({along_x.cell[a], rows.cell[b], along_z.cell[c]},
                    Kokkos::popcount(set & along_z.points[c]));
      }
    }
    if (to_own != 0) cells.add(own, Kokkos::popcount(to_own));
    return cells;
  }

 private:
  /// Rows that hold the points of a grain around the height y; `to_own`: the points that are not in
  /// them but in the grain's own cell.
  KOKKOS_INLINE_FUNCTION PointsAlong rows_of_points(Real y, Real r, int row,
                                                    PointSet& to_own) const {
    constexpr DividedSets sets = divided_sets();
    PointsAlong rows;
    for (int q = 0; q < kDividedOffsets; ++q) {
      const Real at = y + r * divided_offset(q, false);
      if (points == PointModel::cfdem && is_outside(at)) {
        to_own |= sets.y[q];
      } else {
        rows.add(row_of(at, row), sets.y[q]);
      }
    }
    return rows;
  }
  /// Likewise along x, or along z; all of them in the column `own` if the outermost ones are.
  template <bool along_z>
  KOKKOS_INLINE_FUNCTION PointsAlong columns_of_points(Real centre, Real r, int own) const {
    constexpr DividedSets sets = divided_sets();
    const auto column = [&](Real at) { return along_z ? column_z(at) : column_x(at); };
    PointsAlong columns;
    if (column(centre - kOuterShell * r) == column(centre + kOuterShell * r)) {
      columns.add(own, kAllPoints);
      return columns;
    }
    for (int q = 0; q < kDividedOffsets; ++q) {
      const Real at = centre + r * divided_offset(q, along_z);
      columns.add(along_z ? cell_z(at) : cell_x(at), along_z ? sets.z[q] : sets.x[q]);
    }
    return columns;
  }
};

/// On a grid that is not cut.
inline DepositStencil deposit_stencil_in(const GridRef& grid, PointModel points, bool periodic_x) {
  return {.grid = grid,
          .points = points,
          .box = grid.box(periodic_x),
          .i_low = 0,
          .i_high = grid.nx - 1,
          .k_low = 0,
          .k_high = grid.nz - 1};
}

/// Fixed-point numbers: integer sums do not depend on the order of threads or ranks.
struct FixedPoint {
  Real scale = 1;  // integers per unit, a power of two

  KOKKOS_INLINE_FUNCTION std::int64_t encode(Real value) const {
    const Real number = value * scale;
    return static_cast<std::int64_t>(number + (number < 0 ? Real(-0.5) : Real(0.5)));
  }
  KOKKOS_INLINE_FUNCTION Real decode(std::int64_t sum) const {
    return static_cast<Real>(sum) / scale;
  }
};

/// Finest scale with which sums up to `largest` stay inside 62 bits.
inline FixedPoint fixed_point_for(Real largest) {
  if (!(largest > 0)) return {};
  return {Kokkos::pow(Real(2), Kokkos::floor(Kokkos::log2(Real(4.6e18) / largest)))};
}

}  // namespace barchan
