// Sums and maxima over cells and ranks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/fluid/flow_sums.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/exchange.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Sums over ranks, with the same bits on all of them. T is a Real or a std::int64_t.
template <class T>
void sum_over(MPI_Comm ranks, std::vector<T>& numbers) {
  all_reduce(ranks, std::span<T>(numbers), MPI_SUM);
}
template <class T>
T sum_over(MPI_Comm ranks, T number) {
  all_reduce(ranks, std::span(&number, 1), MPI_SUM);
  return number;
}
inline std::int64_t sum_over(MPI_Comm ranks, int number) {
  return sum_over(ranks, std::int64_t{number});
}
inline Real max_over(MPI_Comm ranks, Real number) {
  all_reduce(ranks, std::span(&number, 1), MPI_MAX);
  return number;
}

namespace launch_detail {

/// Reduction to the sum of a functor's values, or to the largest of them.
template <bool largest, class Functor>
struct Reduction {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int item, Real& result) const {
    const CellsOfRow at = cells_of_item(range, item);
    Real row_max = result, row_sum = 0;
    each_part(functor, at, [&at, &row_max, &row_sum](const auto& part, int begin, int end) {
      Body<std::remove_cvref_t<decltype(part)>> body = part;
      const int j = at.j, k = at.k;
      Real part_max = row_max, part_sum = 0;
#pragma omp simd reduction(max : part_max) reduction(+ : part_sum)
      for (int i = begin; i < end; ++i) {
        const Real value = body(i, j, k);
        if constexpr (largest) part_max = value > part_max ? value : part_max;
        part_sum += value;  // a maximum forgets a value that is not a number, a sum does not
      }
      row_max = part_max, row_sum += part_sum;
    });
    if constexpr (largest) {
      result = row_sum == row_sum ? row_max : Kokkos::Experimental::infinity_v<Real>;
    } else {
      result += row_sum;
    }
  }
};

template <class Functor>
using Sum = Reduction<false, Functor>;
template <class Functor>
using Largest = Reduction<true, Functor>;

/// Reduction to the sum of a functor's vectors.
template <class Functor>
struct VectorSum {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int item, Vec3& sum) const {
    const CellsOfRow at = cells_of_item(range, item);
    each_part(functor, at, [&at, &sum](const auto& part, int begin, int end) {
      Body<std::remove_cvref_t<decltype(part)>> body = part;
      const int j = at.j, k = at.k;
      Real row_x = 0, row_y = 0, row_z = 0;
#pragma omp simd reduction(+ : row_x, row_y, row_z)
      for (int i = begin; i < end; ++i) {
        const Vec3 value = body(i, j, k);
        row_x += value.x;
        row_y += value.y;
        row_z += value.z;
      }
      sum += Vec3{row_x, row_y, row_z};
    });
  }
};

/// Reduction to the largest of a functor's values and the sums of two others.
template <class Functor>
struct MaxAndSum {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int item, LargestAndSums& all) const {
    const CellsOfRow at = cells_of_item(range, item);
    each_part(functor, at, [&at, &all](const auto& part, int begin, int end) {
      Body<std::remove_cvref_t<decltype(part)>> body = part;
      const int j = at.j, k = at.k;
      Real row_max = all.largest, row_all = 0, row_x = 0, row_y = 0;
#pragma omp simd reduction(max : row_max) reduction(+ : row_all, row_x, row_y)
      for (int i = begin; i < end; ++i) {
        const LargestAndSums value = body(i, j, k);
        row_max = value.largest > row_max ? value.largest : row_max;
        row_all += value.largest;
        row_x += value.sum.x;
        row_y += value.sum.z;
      }
      const Real largest = row_all == row_all ? row_max : Kokkos::Experimental::infinity_v<Real>;
      join(all, {largest, {row_x, row_y}});
    });
  }
  KOKKOS_FORCEINLINE_FUNCTION static void join(LargestAndSums& all, const LargestAndSums& more) {
    all.largest = Kokkos::max(all.largest, more.largest);
    all.sum.x += more.sum.x;
    all.sum.z += more.sum.z;
  }
};

}  // namespace launch_detail

/// Sum of functor(i, j, k), which may also write, over all cells. The order of additions depends
/// only on the cells of each rank and the numbers of threads and ranks.
template <class Functor>
Real sum_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  Real sum = 0;
  const CellRange range = owned_cells(grid);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::Sum<Functor>{functor, range}, sum);
  return sum_over(ranks_of(grid), sum);
}

/// Largest functor(i, j, k) over all cells, for values that are not negative; infinity if one is
/// not a number.
template <class Functor>
Real max_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  Real largest = 0;
  const CellRange range = owned_cells(grid);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::Largest<Functor>{functor, range},
                          Kokkos::Max<Real>(largest));
  return max_over(ranks_of(grid), largest);
}

}  // namespace barchan
