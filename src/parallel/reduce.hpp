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
void max_over(MPI_Comm ranks, std::vector<T>& numbers) {
  all_reduce(ranks, std::span<T>(numbers), MPI_MAX);
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

/// Sum of functor(i, j, k), which may also write, over the cells of all ranks. The order of
/// additions depends only on the grid and the numbers of threads and ranks.
template <class Functor>
Real sum_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  Real sum = 0;
  const CellRange range = owned_cells(grid);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::SumLoop<Functor>{functor, range}, sum);
  return sum_over(ranks_of(grid), sum);
}

/// Largest functor(i, j, k) over the cells of all ranks, for values that are not negative; infinity
/// if one is not a number.
template <class Functor>
Real max_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  Real largest = 0;
  const CellRange range = owned_cells(grid);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::MaxLoop<Functor>{functor, range},
                          Kokkos::Max<Real>(largest));
  return max_over(ranks_of(grid), largest);
}

}  // namespace barchan
