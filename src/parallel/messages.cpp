#include "src/parallel/messages.hpp"

#include <mpi.h>
#if __has_include(<mpi-ext.h>)
#include <mpi-ext.h>
#endif

#include <array>
#include <numeric>
#include <string>

#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

MessageCounts counts;

std::vector<int> starts_of(const std::vector<int>& sizes) {
  std::vector<int> starts(sizes.size());
  std::exclusive_scan(sizes.begin(), sizes.end(), starts.begin(), 0);
  return starts;
}

template <class T>
void reduce(MPI_Comm ranks, T* numbers, std::size_t n, MPI_Datatype type, MPI_Op operation) {
  if (rank_count(ranks) == 1) return;
  message_detail::count_reduction();
  MPI_Allreduce(MPI_IN_PLACE, numbers, static_cast<int>(n), type, operation, ranks);
}

MPI_Comm ranks_of(const Grid& grid) { return grid.ranks ? grid.ranks->all() : MPI_COMM_SELF; }

}  // namespace

const MessageCounts& message_counts() { return counts; }

void message_detail::count_message(std::size_t words) {
  ++counts.messages;
  counts.bytes += static_cast<std::int64_t>(words * sizeof(Real));
}
void message_detail::count_reduction() { ++counts.reductions; }
void message_detail::count_all_to_all() { ++counts.all_to_alls; }

bool mpi_reaches_device() {
  if (runs_on_host) return true;
#if defined(MPIX_CUDA_AWARE_SUPPORT)
  return MPIX_Query_cuda_support() == 1;
#else
  return false;
#endif
}

MessageBuffer::MessageBuffer(const char* label, std::size_t n) : label_(label) { reserve(n); }

void MessageBuffer::reserve(std::size_t n) {
  if (n <= size()) return;
  const std::size_t room = size() == 0 ? n : n + n / 8;
  numbers_ = Kokkos::View<Real*>(label_, room);
  if (!mpi_reaches_device())
    staged_ = Kokkos::View<Real*, Kokkos::HostSpace>(label_ + ", staged", room);
}

const Real* MessageBuffer::to_send() const {
  if (staged_.extent(0) == 0) {
    Kokkos::fence("messages: written");
    return numbers_.data();
  }
  Kokkos::deep_copy(staged_, numbers_);
  return staged_.data();
}

Real* MessageBuffer::to_receive() const {
  return staged_.extent(0) == 0 ? numbers_.data() : staged_.data();
}

void MessageBuffer::received() const {
  if (staged_.extent(0) > 0) Kokkos::deep_copy(numbers_, staged_);
}

void exchange(const RankLine& line, const Rims& rims) {
  constexpr int forth = 1, back = 2;
  const int n = static_cast<int>(rims.to_after.size());
  std::array<MPI_Request, 4> requests;
  MPI_Irecv(rims.from_before.to_receive(), n, MPI_DOUBLE, line.before(), forth, line.communicator,
            &requests[0]);
  MPI_Irecv(rims.from_after.to_receive(), n, MPI_DOUBLE, line.after(), back, line.communicator,
            &requests[1]);
  MPI_Isend(rims.to_after.to_send(), n, MPI_DOUBLE, line.after(), forth, line.communicator,
            &requests[2]);
  MPI_Isend(rims.to_before.to_send(), n, MPI_DOUBLE, line.before(), back, line.communicator,
            &requests[3]);
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  rims.from_before.received();
  rims.from_after.received();
  message_detail::count_message(rims.to_after.size());
  message_detail::count_message(rims.to_before.size());
}

void exchange_all(const RankLine& line, const MessageBuffer& send,
                  const std::vector<int>& send_counts, const MessageBuffer& receive,
                  const std::vector<int>& receive_counts) {
  const std::vector<int> from = starts_of(send_counts), to = starts_of(receive_counts);
  MPI_Alltoallv(send.to_send(), send_counts.data(), from.data(), MPI_DOUBLE, receive.to_receive(),
                receive_counts.data(), to.data(), MPI_DOUBLE, line.communicator);
  receive.received();
  for (int place = 0; place < line.count; ++place) {
    const int n = send_counts[static_cast<std::size_t>(place)];
    if (place != line.place && n > 0) message_detail::count_message(static_cast<std::size_t>(n));
  }
}

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
  reduce(ranks, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_MAX);
}

Real sum_over_ranks(const Grid& grid, Real mine) { return sum_over(ranks_of(grid), mine); }
Real max_over_ranks(const Grid& grid, Real mine) { return max_over(ranks_of(grid), mine); }
void sum_over_ranks(const Grid& grid, std::vector<Real>& numbers) {
  sum_over(ranks_of(grid), numbers);
}

}  // namespace barchan
