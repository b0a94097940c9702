#include "src/parallel/region.hpp"

#include "src/parallel/mirror.hpp"

#include <algorithm>

namespace barchan {

namespace {

/// Largest number of runs: in a plane of nx columns every second one may be a run.
std::size_t most_runs(const Grid& grid) {
  return static_cast<std::size_t>(grid.nx / 2 + 1) * static_cast<std::size_t>(grid.nz);
}

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

}  // namespace barchan
