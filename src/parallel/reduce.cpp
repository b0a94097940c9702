#include "src/parallel/reduce.hpp"

#include "src/parallel/exchange.hpp"

namespace barchan {

namespace {

void reduce(MPI_Comm ranks, void* numbers, std::size_t n, MPI_Datatype type, MPI_Op operation) {
  if (rank_count(ranks) == 1) return;
  exchange_detail::count_reduction();
  MPI_Allreduce(MPI_IN_PLACE, numbers, static_cast<int>(n), type, operation, ranks);
}

}  // namespace

void all_reduce(MPI_Comm ranks, std::span<Real> numbers, MPI_Op operation) {
  reduce(ranks, numbers.data(), numbers.size(), MPI_DOUBLE, operation);
}
void all_reduce(MPI_Comm ranks, std::span<std::int64_t> numbers, MPI_Op operation) {
  reduce(ranks, numbers.data(), numbers.size(), MPI_INT64_T, operation);
}

}  // namespace barchan
