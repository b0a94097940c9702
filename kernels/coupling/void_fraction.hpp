// Volume of a grain on the grid: the divided void fraction, and deposits that add up to the same
// bits in any order.
#pragma once

#include "kernels/coupling/grain_rows.hpp"
#include "kernels/grains/grain.hpp"

namespace barchan {

/// Columns of cells along x or z that share a grain, and which points each holds.
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

/// Indices of a cell, owned or a ghost beside an owned one. They have no default values: GrainCells
/// has many.
struct CellIndex {
  int i, j, k;
  /// Number of the cell among the owned cells and the ghosts around them in x and z.
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

/// Cells that share a grain, and its share in each; the shares add up to one.
struct GrainCells {
  int n = 0;
  CellIndex cell[kDividedPoints];
  Real share[kDividedPoints];

  /// Adds a cell that is not there yet, unless it holds no point.
  KOKKOS_INLINE_FUNCTION void put(const CellIndex& c, int points, Real share_of_point) {
    if (points == 0) return;
    cell[n] = c;
    share[n++] = points * share_of_point;
  }
  KOKKOS_INLINE_FUNCTION void add(const CellIndex& c, int points, Real share_of_point) {
    for (int q = 0; q < n; ++q) {
      if (cell[q] == c) {
        share[q] += points * share_of_point;
        return;
      }
    }
    put(c, points, share_of_point);
  }
  KOKKOS_INLINE_FUNCTION Real weight(int q) const { return share[q]; }
};

/// Points that stand for a grain. `divided`: each row of cells has the exact part of the sphere in
/// it, which the row's points share, or has the column of the centre. `cfdem`: all points have
/// equal shares, and one outside gives its to the grain's own cell, as CFDEM does.
enum class PointModel { divided, centre, cfdem };

/// Finds the cells of a grain. No volume is lost: the rows beside floor and lid have what lies
/// beyond them, a point beyond the outlet goes to the last cell, periodic directions wrap. Where
/// the grid is cut among ranks, points of a grain inside may lie in the ghosts of the neighbours'
/// cells.
struct DepositStencil {
  GridRef grid;
  PointModel points = PointModel::divided;
  PeriodicBox box;            // directions that are periodic and not cut
  int i_low = 0, i_high = 0;  // a point beyond belongs to these
  int k_low = 0, k_high = 0;

  /// Wraps an index that is rarely a period off to 0 .. n - 1.
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
  /// The owned or ghost cell of a column.
  KOKKOS_INLINE_FUNCTION int place_x(int column) const {
    return Kokkos::clamp(box.lx > 0 ? wrap(column, grid.nx) : column, i_low, i_high);
  }
  KOKKOS_INLINE_FUNCTION int place_z(int column) const {
    return Kokkos::clamp(box.lz > 0 ? wrap(column, grid.nz) : column, k_low, k_high);
  }
  KOKKOS_INLINE_FUNCTION GrainRows rows_of(const GrainKinematics& g) const {
    return {grid, g.x.y, g.r};
  }

  KOKKOS_INLINE_FUNCTION GrainCells operator()(const GrainKinematics& g) const {
    return (*this)(g, rows_of(g));
  }
  KOKKOS_INLINE_FUNCTION GrainCells operator()(const GrainKinematics& g,
                                               const GrainRows& rows) const {
    GrainCells cells;
    const Vec3 x = box.wrap(g.x);
    const CellIndex own{place_x(column_x(x.x)), rows.row[0], place_z(column_z(x.z))};
    if (points == PointModel::centre) {
      cells.put(own, 1, 1);
      return cells;
    }
    const PointsAlong along_x = columns_of_points<false>(x.x, g.r);
    const PointsAlong along_z = columns_of_points<true>(x.z, g.r);
    const bool equal = points == PointModel::cfdem;
    const PointSet to_own = equal ? rows.outside : 0;
    for (int b = 0; b < rows.n; ++b) {
      const PointSet in_row = rows.points[b] != 0 || equal ? rows.points[b] : kCentrePoint;
      const Real of_point = equal ? kShareOfPoint : rows.weight(b) / Kokkos::popcount(in_row);
      for (int a = 0; a < along_x.n; ++a) {
        const PointSet set = in_row & along_x.points[a] & ~to_own;
        for (int c = 0; c < along_z.n; ++c)
          cells.put({along_x.cell[a], rows.row[b], along_z.cell[c]},
                    Kokkos::popcount(set & along_z.points[c]), of_point);
      }
    }
    if (to_own != 0) cells.add(own, Kokkos::popcount(to_own), kShareOfPoint);
    return cells;
  }

 private:
  static constexpr Real kShareOfPoint = Real(1) / kDividedPoints;

  /// Columns along x, or along z, that hold the points of a grain; the first is that of its centre.
  template <bool along_z>
  KOKKOS_INLINE_FUNCTION PointsAlong columns_of_points(Real centre, Real r) const {
    constexpr DividedSets sets = divided_sets();
    const auto column = [&](Real at) { return along_z ? column_z(at) : column_x(at); };
    const auto place = [&](int c) { return along_z ? place_z(c) : place_x(c); };
    const auto column_of = [&](int q) { return column(centre + r * divided_offset(q, along_z)); };
    const auto& set = along_z ? sets.z : sets.x;
    const int first = column(centre - kOuterShell * r), last = column(centre + kOuterShell * r);
    PointsAlong columns;
    if (first == last) {
      columns.add(place(first), kAllPoints);
    } else if (last == first + 1) {
      PointSet beyond = 0;
      for (int q = 0; q < kDividedOffsets; ++q) beyond |= column_of(q) == last ? set[q] : 0;
      const bool own_is_last = column(centre) == last;
      columns.add(place(own_is_last ? last : first), own_is_last ? beyond : kAllPoints & ~beyond);
      columns.add(place(own_is_last ? first : last), own_is_last ? kAllPoints & ~beyond : beyond);
    } else {
      for (int q = 0; q < kDividedOffsets; ++q) columns.add(place(column_of(q)), set[q]);
    }
    return columns;
  }
};

/// Deposit stencil on a grid that is not cut among ranks.
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
KOKKOS_INLINE_FUNCTION FixedPoint fixed_point_for(Real largest) {
  if (!(largest > 0)) return {};
  return {Kokkos::pow(Real(2), Kokkos::floor(Kokkos::log2(Real(4.6e18) / largest)))};
}

}  // namespace barchan
