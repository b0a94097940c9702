// The cells of this rank near grains: kernels run in them, or in them and elsewhere in other ways.
#pragma once

#include <cstdint>

#include "src/parallel/column_map.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Of columns of cells the part of this rank.
class Region {
 public:
  /// All cells.
  explicit Region(const Grid& grid);

  void set(const ColumnMap& columns);
  /// Those that it was made of.
  const ColumnMap& columns() const { return columns_; }

  /// For kernels.
  RegionRef ref() const { return {range_, active_.data(), runs_.data(), first_run_.data()}; }
  /// All rows and planes that have cells, whole.
  const CellRange& range() const { return range_; }
  /// Its columns.
  CellRange floor() const { return {range_.i0, range_.i1, 0, 1, range_.k0, range_.k1}; }
  /// Whether ghosts in x and z are copies of its cells, or may be. The same on all ranks.
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

/// Cells near grains, and with one more on all sides.
struct NearGrains {
  explicit NearGrains(const Grid& grid) : cells(grid), around(grid) {}
  void set(const ColumnMap& columns) {
    cells.set(columns);
    around.set(columns.grown(1));
  }
  Region cells, around;
};

/// functor(i, j, k) for the cells of a region.
template <class Functor>
void for_each_cell(const char* label, const Region& region, const Functor& functor) {
  for_each_cell(label, region.range(), Within<Functor>{region.ref(), functor});
}
/// For its columns (i, 0, k).
template <class Functor>
void for_each_column(const char* label, const Region& region, const Functor& functor) {
  for_each_cell(label, region.floor(), Within<Functor>{region.ref(), functor});
}

}  // namespace barchan
