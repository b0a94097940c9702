// Loops over the grid. On a CPU rows (j, k) run in parallel and i is vectorised; on a device
// every cell is a work item.
#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/fluid/grid.hpp"
#include "kernels/math/on_host.hpp"

namespace barchan {

/// Half-open index box. Faces take the range of the cells above them; ghosts are reached with
/// bounds from -1 to n + 1.
struct CellRange {
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0, k0 = 0, k1 = 0;
};
template <class Rows>
CellRange owned_cells(const BasicGrid<Rows>& grid) {
  return {0, grid.nx, 0, grid.ny, 0, grid.nz};
}

/// Range of work items 0..n-1. "Light" makes a device take the functor as the kernel's argument.
/// Kokkos would copy one of more than 512 bytes through a buffer in constant memory, and wait at
/// every launch until the last kernel that used the buffer is done.
using Items = Kokkos::RangePolicy<Kokkos::DefaultExecutionSpace, Kokkos::IndexType<int>,
                                  Kokkos::Experimental::WorkItemProperty::HintLightWeight_t>;
inline Items items(int n) { return Items(0, n); }

/// Part of the cells of a range: whole columns, up to its rows.
struct RegionRef {
  /// Columns [begin, end) of a plane.
  struct Run {
    int begin, end;
  };
  CellRange range;
  const std::uint8_t* active = nullptr;  // (i, k): column is in the region
  // Runs of all planes, on a host alone; the runs of plane k begin at first_run[k].
  const Run* runs = nullptr;
  const int* first_run = nullptr;

  KOKKOS_FORCEINLINE_FUNCTION bool has_row(int j, int k) const {
    return j < range.j1 && k >= range.k0 && k < range.k1;
  }
  KOKKOS_FORCEINLINE_FUNCTION bool has(int i, int j, int k) const {
    return has_row(j, k) && active[i + (range.i1 - range.i0) * k] != 0;
  }
};

/// Functor for the cells of a region alone.
template <class Inside>
struct Within {
  RegionRef region;
  Inside inside;
};

/// Pair of functors: one for the cells of a region, another for all others. Either may be a
/// ByRegion again.
template <class Inside, class Outside>
struct ByRegion {
  RegionRef region;
  Inside inside;
  Outside outside;
};

namespace launch_detail {

inline Items policy(const CellRange& r) {
  const int rows = (r.j1 - r.j0) * (r.k1 - r.k0);
  return items(kOnHost ? rows : rows * (r.i1 - r.i0));
}

/// Cells [i0, i1) of a row.
struct CellsOfRow {
  int i0, i1, j, k;
};
/// Cells of a work item: a row on the host, a single cell on a device.
KOKKOS_FORCEINLINE_FUNCTION CellsOfRow cells_of_item(const CellRange& r, int item) {
  const int length = kOnHost ? 1 : r.i1 - r.i0;
  const int rows_y = r.j1 - r.j0, row = item / length, i0 = r.i0 + item % length;
  return {i0, kOnHost ? r.i1 : i0 + 1, r.j0 + row % rows_y, r.k0 + row / rows_y};
}

/// Functor within a work item. On the host it is a local copy: its members stay in registers.
template <class Functor>
using Body = std::conditional_t<kOnHost, const Functor, const Functor&>;

/// Calls action(functor, first, last) for the cells [first, last) of a row that take it.
template <class Functor, class Action>
KOKKOS_FORCEINLINE_FUNCTION void each_part(const Functor& functor, const CellsOfRow& at,
                                           const Action& action) {
  action(functor, at.i0, at.i1);
}
/// Calls action(is inside, stretch) for stretches of a row: those in a region, and those between
/// them.
template <class Action>
KOKKOS_FORCEINLINE_FUNCTION void each_stretch(const RegionRef& region, const CellsOfRow& at,
                                              const Action& action) {
  if (!kOnHost) return action(region.has(at.i0, at.j, at.k), at);
  int begin = at.i0;
  if (region.has_row(at.j, at.k)) {
    for (int r = region.first_run[at.k]; r < region.first_run[at.k + 1]; ++r) {
      const RegionRef::Run run = region.runs[r];
      const int first = Kokkos::clamp(run.begin, begin, at.i1);
      const int last = Kokkos::clamp(run.end, first, at.i1);
      action(false, CellsOfRow{begin, first, at.j, at.k});
      action(true, CellsOfRow{first, last, at.j, at.k});
      begin = last;
    }
  }
  action(false, CellsOfRow{begin, at.i1, at.j, at.k});
}
template <class Inside, class Outside, class Action>
KOKKOS_FORCEINLINE_FUNCTION void each_part(const ByRegion<Inside, Outside>& functor,
                                           const CellsOfRow& at, const Action& action) {
  each_stretch(functor.region, at, [&](bool is_inside, const CellsOfRow& cells) {
    if (is_inside) {
      each_part(functor.inside, cells, action);
    } else {
      each_part(functor.outside, cells, action);
    }
  });
}
template <class Inside, class Action>
KOKKOS_FORCEINLINE_FUNCTION void each_part(const Within<Inside>& functor, const CellsOfRow& at,
                                           const Action& action) {
  each_stretch(functor.region, at, [&](bool is_inside, const CellsOfRow& cells) {
    if (is_inside) action(functor.inside, cells.i0, cells.i1);
  });
}

template <class Functor>
struct Loop {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int item) const {
    const CellsOfRow at = cells_of_item(range, item);
    each_part(functor, at, [&at](const auto& part, int begin, int end) {
      Body<std::remove_cvref_t<decltype(part)>> body = part;
      const int j = at.j, k = at.k;
#pragma omp simd
      for (int i = begin; i < end; ++i) body(i, j, k);
    });
  }
};

}  // namespace launch_detail

/// Calls functor(i, j, k) for every index of the range.
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
