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

inline constexpr bool runs_on_host =
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
  return items(runs_on_host ? rows : rows * (r.i1 - r.i0));
}

/// Index of a row (host) or of a cell (device) back to i, j, k.
struct CellOfItem {
  int i, j, k;
  KOKKOS_INLINE_FUNCTION static CellOfItem of_row(const CellRange& r, int row) {
    const int rows_y = r.j1 - r.j0;
    return {r.i0, r.j0 + row % rows_y, r.k0 + row / rows_y};
  }
  KOKKOS_INLINE_FUNCTION static CellOfItem of_cell(const CellRange& r, int cell) {
    const int length = r.i1 - r.i0;
    CellOfItem at = of_row(r, cell / length);
    at.i += cell % length;
    return at;
  }
};

template <class Functor>
struct Loop {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int index) const {
    if constexpr (runs_on_host) {
      const Functor body = functor;  // a local copy: its members stay in registers
      const CellOfItem at = CellOfItem::of_row(range, index);
      const int end = range.i1;
#pragma omp simd
      for (int i = at.i; i < end; ++i) body(i, at.j, at.k);
    } else {
      const CellOfItem at = CellOfItem::of_cell(range, index);
      functor(at.i, at.j, at.k);
    }
  }
};

template <class Functor>
struct SumLoop {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int index, Real& sum) const {
    if constexpr (runs_on_host) {
      const Functor body = functor;
      const CellOfItem at = CellOfItem::of_row(range, index);
      const int end = range.i1;
      Real row_sum = 0;
#pragma omp simd reduction(+ : row_sum)
      for (int i = at.i; i < end; ++i) row_sum += body(i, at.j, at.k);
      sum += row_sum;
    } else {
      const CellOfItem at = CellOfItem::of_cell(range, index);
      sum += functor(at.i, at.j, at.k);
    }
  }
};

template <class Functor>
struct MaxLoop {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int index, Real& largest) const {
    if constexpr (runs_on_host) {
      const Functor body = functor;
      const CellOfItem at = CellOfItem::of_row(range, index);
      const int end = range.i1;
      Real row_max = largest, row_sum = 0;
#pragma omp simd reduction(max : row_max) reduction(+ : row_sum)
      for (int i = at.i; i < end; ++i) {
        const Real value = body(i, at.j, at.k);
        row_max = value > row_max ? value : row_max;
        row_sum += value;  // a maximum forgets what is not a number, a sum does not
      }
      largest = row_sum == row_sum ? row_max : Kokkos::Experimental::infinity_v<Real>;
    } else {
      const CellOfItem at = CellOfItem::of_cell(range, index);
      const Real value = functor(at.i, at.j, at.k);
      const Real known = value == value ? value : Kokkos::Experimental::infinity_v<Real>;
      largest = known > largest ? known : largest;
    }
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
