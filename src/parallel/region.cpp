#include "src/parallel/region.hpp"

#include <algorithm>

#include "kernels/math/raise_to.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

/// Largest number of runs: in a plane of nx columns every second one may be a run.
std::size_t most_runs(const Grid& grid) {
  return static_cast<std::size_t>(grid.nx / 2 + 1) * static_cast<std::size_t>(grid.nz);
}

/// Marks columns of a region in which a field is not one: on a host a plane a work item, on a
/// device a column.
struct MarkNotOne {
  RegionRef region;
  ConstFieldRef field;
  int first, stride, last;   // mark of this rank's first column, from plane to plane, of the height
  Kokkos::View<int*> marks;  // marks of all ranks

  KOKKOS_FUNCTION void operator()(int item) const {
    const CellRange& range = region.range;
    const int length = kOnHost ? 1 : range.i1 - range.i0;
    const int k = range.k0 + item / length, i = range.i0 + item % length;
    int top = 0;
    if (kOnHost) {
      for (int r = region.first_run[k]; r < region.first_run[k + 1]; ++r)
        top = Kokkos::max(top, mark(region.runs[r].begin, region.runs[r].end, k));
    } else if (region.has(i, 0, k)) {
      top = mark(i, i + 1, k);
    }
    raise_to(&marks(last), top);
  }

 private:
  /// Marks columns [begin, end) of a plane; returns the number of rows up to the highest cell.
  KOKKOS_FORCEINLINE_FUNCTION int mark(int begin, int end, int k) const {
    int* const column = marks.data() + first + static_cast<std::ptrdiff_t>(stride) * k;
    int top = 0;
    for (int j = 0; j < region.range.j1; ++j) {
      int found = 0;
#pragma omp simd reduction(| : found)
      for (int i = begin; i < end; ++i) {
        const int here = field(i, j, k) != 1 ? 1 : 0;
        column[i] |= here;
        found |= here;
      }
      top = found != 0 ? j + 1 : top;
    }
    return top;
  }
};

}  // namespace

Region::Region(const Grid& grid)
    : grid_(grid),
      active_("region: columns",
              static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.nz)),
      active_on_host_(mirror(active_)),
      runs_("host: runs", most_runs(grid)),
      first_run_("host: first runs", static_cast<std::size_t>(grid.nz) + 1) {
  set(ColumnMap::everything(grid));
}

void Region::set(const ColumnMap& columns) {
  columns_ = columns;
  const int nx = grid_.nx, nz = grid_.nz;
  int first = nz, last = 0, n_runs = 0;
  bool at_side = false;
  for (int k = 0; k < nz; ++k) {
    first_run_(static_cast<std::size_t>(k)) = n_runs;
    bool before = false;
    for (int i = 0; i < nx; ++i) {
      const bool here = !columns.is_empty() && columns.has(grid_.i_begin + i, grid_.k_begin + k);
      active_on_host_(static_cast<std::size_t>(i + nx * k)) = here ? 1 : 0;
      if (here && !before) runs_(static_cast<std::size_t>(n_runs++)).begin = i;
      if (here) runs_(static_cast<std::size_t>(n_runs - 1)).end = i + 1;
      if (here) first = std::min(first, k), last = k + 1;
      at_side = at_side || (here && (i == 0 || i + 1 == nx || k == 0 || k + 1 == nz));
      before = here;
    }
  }
  first_run_(static_cast<std::size_t>(nz)) = n_runs;
  // Copy in order with the kernels, without a wait: the step waits before this is written again.
  Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), active_, active_on_host_);
  range_ =
      first < last ? CellRange{0, nx, 0, columns.top(), first, last} : CellRange{0, nx, 0, 0, 0, 0};
  has_ghosts_ = grid_.ranks != nullptr || at_side;
}

void mark_not_one(const ColumnMarks& marks, int row, const Grid& grid, const Field& field,
                  const Region& region) {
  const CellRange& range = region.range();
  const int planes = range.k1 - range.k0;
  Kokkos::parallel_for("columns: not one", items(kOnHost ? planes : planes * (range.i1 - range.i0)),
                       MarkNotOne{.region = region.ref(),
                                  .field = field,
                                  .first = grid.i_begin + grid.nx_all * grid.k_begin,
                                  .stride = grid.nx_all,
                                  .last = grid.nx_all * grid.nz_all,
                                  .marks = marks.row(row)});
}

}  // namespace barchan
