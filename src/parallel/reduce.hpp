// Sums and maxima over cells and ranks.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "src/parallel/grid.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Numbers summed or compared over ranks, the same on all of them; counted as one reduction.
void sum_over(MPI_Comm ranks, std::vector<std::int64_t>& numbers);
std::int64_t sum_over(MPI_Comm ranks, std::int64_t number);
inline std::int64_t sum_over(MPI_Comm ranks, int number) {
  return sum_over(ranks, std::int64_t{number});
}
Real sum_over(MPI_Comm ranks, Real number);
void sum_over(MPI_Comm ranks, std::vector<Real>& numbers);
Real max_over(MPI_Comm ranks, Real number);
void max_over(MPI_Comm ranks, std::vector<Real>& numbers);

/// Over the ranks that share the grid, the same bits on all of them.
Real sum_over_ranks(const Grid& grid, Real mine);
void sum_over_ranks(const Grid& grid, std::vector<Real>& numbers);
Real max_over_ranks(const Grid& grid, Real mine);

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
