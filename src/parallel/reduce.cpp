#include "src/parallel/reduce.hpp"

#include "src/parallel/decomposition.hpp"
#include "src/parallel/exchange.hpp"

namespace barchan {

namespace {

template <class T>
void reduce(MPI_Comm ranks, T* numbers, std::size_t n, MPI_Datatype type, MPI_Op operation) {
  if (rank_count(ranks) == 1) return;
  exchange_detail::count_reduction();
  MPI_Allreduce(MPI_IN_PLACE, numbers, static_cast<int>(n), type, operation, ranks);
}

MPI_Comm ranks_of(const Grid& grid) { return grid.ranks ? grid.ranks->all() : MPI_COMM_SELF; }

}  // namespace

void sum_over(MPI_Comm ranks, std::vector<std::int64_t>& numbers) {
  reduce(ranks, numbers.data(), numbers.size(), MPI_INT64_T, MPI_SUM);
}
void sum_over(MPI_Comm ranks, std::vector<Real>& numbers) {
  reduce(ranks, numbers.data(), numbers.size(), MPI_DOUBLE, MPI_SUM);
}
std::int64_t sum_over(MPI_Comm ranks, std::int64_t number) {
  reduce(ranks, &number, 1, MPI_INT64_T, MPI_SUM);
  return number;
}
Real sum_over(MPI_Comm ranks, Real number) {
  reduce(ranks, &number, 1, MPI_DOUBLE, MPI_SUM);
  return number;
}
Real max_over(MPI_Comm ranks, Real number) {
  reduce(ranks, &number, 1, MPI_DOUBLE, MPI_MAX);
  return number;
}
void max_over(MPI_Comm ranks, std::vector<Real>& numbers) {
  reduce(ranks, numbers.data(), numbers.size(), MPI_DOUBLE, MPI_MAX);
}

Real sum_over_ranks(const Grid& grid, Real mine) { return sum_over(ranks_of(grid), mine); }
Real max_over_ranks(const Grid& grid, Real mine) { return max_over(ranks_of(grid), mine); }
void sum_over_ranks(const Grid& grid, std::vector<Real>& numbers) {
  sum_over(ranks_of(grid), numbers);
}

}  // namespace barchan
