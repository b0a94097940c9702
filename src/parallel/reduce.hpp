// Sums and maxima over cells and ranks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

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
    Body<Functor> body = functor;
    const CellsOfItem at(range, item);
    Real row_max = result, row_sum = 0;
#pragma omp simd reduction(max : row_max) reduction(+ : row_sum)
    for (int i = at.i0; i < at.i1; ++i) {
      const Real value = body(i, at.j, at.k);
      if constexpr (largest) row_max = value > row_max ? value : row_max;
      row_sum += value;  // a maximum forgets what is not a number, a sum does not
    }
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
    Body<Functor> body = functor;
    const CellsOfItem at(range, item);
    Real row_x = 0, row_y = 0, row_z = 0;
#pragma omp simd reduction(+ : row_x, row_y, row_z)
    for (int i = at.i0; i < at.i1; ++i) {
      const Vec3 value = body(i, at.j, at.k);
      row_x += value.x;
      row_y += value.y;
      row_z += value.z;
    }
    x += row_x;
    y += row_y;
    z += row_z;
  }
};

}  // namespace launch_detail

/// Sum of functor(i, j, k), which may also write, over the cells of all ranks. The order of
/// additions depends only on the grid and the numbers of threads and ranks.
template <class Functor>
Real sum_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  Real sum = 0;
  const CellRange range = owned_cells(grid);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::Reduction<false, Functor>{functor, range}, sum);
  return sum_over(ranks_of(grid), sum);
}

/// The same of vectors, over the given cells of each rank.
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

/// Largest functor(i, j, k) over the cells of this rank, for values that are not negative; infinity
/// if one is not a number.
template <class Functor>
Real max_each_cell_here(const char* label, const Grid& grid, const Functor& functor) {
  Real largest = 0;
  const CellRange range = owned_cells(grid);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::Reduction<true, Functor>{functor, range},
                          Kokkos::Max<Real>(largest));
  return largest;
}
/// Of all ranks.
template <class Functor>
Real max_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  return max_over(ranks_of(grid), max_each_cell_here(label, grid, functor));
}

}  // namespace barchan
