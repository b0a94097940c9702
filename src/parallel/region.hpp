// Region: the cells of this rank near grains. Kernels run in it, or in it and elsewhere in
// different ways.
#pragma once

#include <cstdint>

#include "src/parallel/column_map.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// This rank's part of a ColumnMap.
class Region {
 public:
  /// Region of all cells.
  explicit Region(const Grid& grid);

  void set(const ColumnMap& columns);
  /// Columns that the region was made of.
  const ColumnMap& columns() const { return columns_; }

  /// Region for kernels.
  RegionRef ref() const { return {range_, active_.data(), runs_.data(), first_run_.data()}; }
  /// Range of all rows and planes that have cells, whole.
  const CellRange& range() const { return range_; }
  /// Columns of the range: its lowest row.
  CellRange floor() const { return {range_.i0, range_.i1, 0, 1, range_.k0, range_.k1}; }
  /// Tells if ghosts in x and z are, or may be, copies of cells in the region. The same on all
  /// ranks.
  bool has_ghosts() const { return has_ghosts_; }

 private:
  Grid grid_;
  ColumnMap columns_;
  Kokkos::View<std::uint8_t*> active_;  // (nx, nz)
  Kokkos::View<std::uint8_t*>::host_mirror_type active_on_host_;
  // Runs of columns, plane by plane: for kernels that run on the host.
  Kokkos::View<RegionRef::Run*, Kokkos::HostSpace> runs_;
  Kokkos::View<int*, Kokkos::HostSpace> first_run_;  // (nz + 1)
  CellRange range_;
  bool has_ghosts_ = true;
};

/// Cells near grains, and the same with one more on all sides.
struct ActiveRegion {
  explicit ActiveRegion(const Grid& grid) : cells(grid), dilated(grid) {}
  void set(const ColumnMap& columns) {
    cells.set(columns);
    dilated.set(columns.dilated(1));
  }
  Region cells, dilated;
};

/// Marks the columns of this rank where a field is not one in a region, up to its highest such
/// cell.
void mark_not_one(const ColumnMarks& marks, int row, const Grid& grid, const Field& field,
                  const Region& region);

/// Calls functor(i, j, k) for the cells of a region.
template <class Functor>
void for_each_cell(const char* label, const Region& region, const Functor& functor) {
  for_each_cell(label, region.range(), Within<Functor>{region.ref(), functor});
}
/// Calls functor(i, 0, k) for the columns of a region.
template <class Functor>
void for_each_column(const char* label, const Region& region, const Functor& functor) {
  for_each_cell(label, region.floor(), Within<Functor>{region.ref(), functor});
}

}  // namespace barchan
