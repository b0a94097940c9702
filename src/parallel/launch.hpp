// Loops over the grid. On a CPU rows (j, k) run in parallel and i is vectorised; on a device
// every cell is a work item.
#pragma once

#include <type_traits>

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// Half-open index box. Faces take the range of the cells above them; ghosts are reached with
/// bounds from -1 to n + 1.
struct CellRange {
  int i0, i1, j0, j1, k0, k1;
};
template <class Rows>
CellRange owned_cells(const BasicGrid<Rows>& grid) {
  return {0, grid.nx, 0, grid.ny, 0, grid.nz};
}

inline constexpr bool kRunsOnHost =
    std::is_same_v<Kokkos::DefaultExecutionSpace, Kokkos::DefaultHostExecutionSpace>;

/// Work items 0..n-1. "Light" makes a device take the functor as the kernel's argument. Kokkos
/// would copy one of more than 512 bytes through a buffer in constant memory, and wait at every
/// launch until the last kernel that used the buffer is done.
using Items = Kokkos::RangePolicy<Kokkos::DefaultExecutionSpace, Kokkos::IndexType<int>,
                                  Kokkos::Experimental::WorkItemProperty::HintLightWeight_t>;
inline Items items(int n) { return Items(0, n); }

namespace launch_detail {

inline Items policy(const CellRange& r) {
  const int rows = (r.j1 - r.j0) * (r.k1 - r.k0);
  return items(kRunsOnHost ? rows : rows * (r.i1 - r.i0));
}

/// The cells of a work item: a row on the host, a single cell on a device.
struct CellsOfItem {
  int i0, i1, j, k;
  KOKKOS_FORCEINLINE_FUNCTION CellsOfItem(const CellRange& r, int item) {
    const int length = kRunsOnHost ? 1 : r.i1 - r.i0;
    const int rows_y = r.j1 - r.j0, row = item / length;
    i0 = r.i0 + item % length;
    i1 = kRunsOnHost ? r.i1 : i0 + 1;
    j = r.j0 + row % rows_y;
    k = r.k0 + row / rows_y;
  }
};

/// A functor within a work item. On the host a local copy: its members stay in registers.
template <class Functor>
using Body = std::conditional_t<kRunsOnHost, const Functor, const Functor&>;

template <class Functor>
struct Loop {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int item) const {
    Body<Functor> body = functor;
    const CellsOfItem at(range, item);
#pragma omp simd
    for (int i = at.i0; i < at.i1; ++i) body(i, at.j, at.k);
  }
};

}  // namespace launch_detail

/// functor(i, j, k) for every index of the range.
template <class Functor>
void for_each_cell(const char* label, const CellRange& range, const Functor& functor) {
  Kokkos::parallel_for(label, launch_detail::policy(range),
                       launch_detail::Loop<Functor>{functor, range});
}
template <class Rows, class Functor>
void for_each_cell(const char* label, const BasicGrid<Rows>& grid, const Functor& functor) {
  for_each_cell(label, owned_cells(grid), functor);
}

}  // namespace barchan
