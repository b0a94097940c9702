// Sums and maxima over cells and ranks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/fluid/flow_sums.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/exchange.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Over ranks, the same bits on all of them. A T is a Real or a std::int64_t.
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

/// The sum of a functor's values, or the largest of them.
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
        part_sum += value;  // a maximum forgets what is not a number, a sum does not
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

/// The sum of a functor's vectors.
template <class Functor>
struct VectorSum {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int item, Real& x, Real& y, Real& z) const {
    const CellsOfRow at = cells_of_item(range, item);
    each_part(functor, at, [&at, &x, &y, &z](const auto& part, int begin, int end) {
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
      x += row_x;
      y += row_y;
      z += row_z;
    });
  }
};

/// The largest of a functor's values and the sums of two others.
template <class Functor>
struct MaxAndSum {
  Functor functor;
  CellRange range;
  KOKKOS_FUNCTION void operator()(int item, Real& largest, Real& x, Real& y) const {
    const CellsOfRow at = cells_of_item(range, item);
    each_part(functor, at, [&at, &largest, &x, &y](const auto& part, int begin, int end) {
      Body<std::remove_cvref_t<decltype(part)>> body = part;
      const int j = at.j, k = at.k;
      Real row_max = largest, row_all = 0, row_x = 0, row_y = 0;
#pragma omp simd reduction(max : row_max) reduction(+ : row_all, row_x, row_y)
      for (int i = begin; i < end; ++i) {
        const LargestAndSums value = body(i, j, k);
        row_max = value.largest > row_max ? value.largest : row_max;
        row_all += value.largest;
        row_x += value.sum.x;
        row_y += value.sum.z;
      }
      largest = row_all == row_all ? row_max : Kokkos::Experimental::infinity_v<Real>;
      x += row_x;
      y += row_y;
    });
  }
};

}  // namespace launch_detail

/// Sum of functor(i, j, k), which may also write, over the given cells of each rank, by default
/// all. The order of additions depends only on these cells and the numbers of threads and ranks.
template <class Functor>
Real sum_each_cell(const char* label, const Grid& grid, const CellRange& range,
                   const Functor& functor) {
  Real sum = 0;
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::Reduction<false, Functor>{functor, range}, sum);
  return sum_over(ranks_of(grid), sum);
}
template <class Functor>
Real sum_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  return sum_each_cell(label, grid, owned_cells(grid), functor);
}

/// The same of vectors.
template <class Functor>
Vec3 sum_vector(const char* label, const Grid& grid, const CellRange& range,
                const Functor& functor) {
  std::vector<Real> sum(3);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::VectorSum<Functor>{functor, range}, sum[0], sum[1],
                          sum[2]);
  sum_over(ranks_of(grid), sum);
  return {sum[0], sum[1], sum[2]};
}

/// Largest functor(i, j, k) over the given cells of this rank, by default all, for values that are
/// not negative; infinity if one is not a number.
template <class Functor>
Real max_each_cell_here(const char* label, const CellRange& range, const Functor& functor) {
  Real largest = 0;
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::Reduction<true, Functor>{functor, range},
                          Kokkos::Max<Real>(largest));
  return std::max<Real>(largest, 0);  // of no cells
}
/// Of all ranks.
template <class Functor>
Real max_each_cell(const char* label, const Grid& grid, const CellRange& range,
                   const Functor& functor) {
  return max_over(ranks_of(grid), max_each_cell_here(label, range, functor));
}
template <class Functor>
Real max_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  return max_each_cell(label, grid, owned_cells(grid), functor);
}

/// Of functors that return LargestAndSums: the largest, not negative, and the sums, over all ranks;
/// infinity if one of the former is not a number.
template <class Functor>
LargestAndSums largest_and_sums(const char* label, const Grid& grid, const Functor& functor) {
  LargestAndSums all;
  const CellRange range = owned_cells(grid);
  std::vector<Real> sum(2);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::MaxAndSum<Functor>{functor, range},
                          Kokkos::Max<Real>(all.largest), sum[0], sum[1]);
  sum_over(ranks_of(grid), sum);
  return {max_over(ranks_of(grid), all.largest), {sum[0], sum[1]}};
}

}  // namespace barchan
