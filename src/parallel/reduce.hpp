// Sums and maxima over cells and ranks.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "src/parallel/decomposition.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Numbers summed or compared over ranks, the same on all of them; counted as one reduction.
void all_reduce(MPI_Comm ranks, std::span<Real> numbers, MPI_Op operation);
void all_reduce(MPI_Comm ranks, std::span<std::int64_t> numbers, MPI_Op operation);

template <class T>
void sum_over(MPI_Comm ranks, std::vector<T>& numbers) {
  all_reduce(ranks, std::span<T>(numbers), MPI_SUM);
}
template <class T>
void max_over(MPI_Comm ranks, std::vector<T>& numbers) {
  all_reduce(ranks, std::span<T>(numbers), MPI_MAX);
}
inline Real sum_over(MPI_Comm ranks, Real number) {
  all_reduce(ranks, std::span(&number, 1), MPI_SUM);
  return number;
}
inline std::int64_t sum_over(MPI_Comm ranks, std::int64_t number) {
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

/// Over the ranks that share the grid, the same bits on all of them.
inline Real sum_over_ranks(const Grid& grid, Real mine) { return sum_over(ranks_of(grid), mine); }
inline Real max_over_ranks(const Grid& grid, Real mine) { return max_over(ranks_of(grid), mine); }
inline void sum_over_ranks(const Grid& grid, std::vector<Real>& numbers) {
  sum_over(ranks_of(grid), numbers);
}

/// Sum of functor(i, j, k), which may also write, over the cells of all ranks. The order of
/// additions depends only on the grid and the numbers of threads and ranks.
template <class Functor>
Real sum_each_cell(const char* label, const Grid& grid, const Functor& functor) {
  Real sum = 0;
  const CellRange range = owned_cells(grid);
  Kokkos::parallel_reduce(label, launch_detail::policy(range),
                          launch_detail::SumLoop<Functor>{functor, range}, sum);
  return sum_over_ranks(grid, sum);
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
  return max_over_ranks(grid, largest);
}

}  // namespace barchan
