#include "src/parallel/exchange.hpp"

#if __has_include(<mpi-ext.h>)
#include <mpi-ext.h>
#endif

#include <array>
#include <numeric>
#include <utility>

#include "src/parallel/communicator.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

MessageCounts sent_so_far;

void count_message(std::size_t numbers) {
  ++sent_so_far.messages;
  sent_so_far.bytes += static_cast<std::int64_t>(numbers * sizeof(Real));
}

std::vector<int> starts_of(const std::vector<int>& sizes) {
  std::vector<int> starts(sizes.size());
  std::exclusive_scan(sizes.begin(), sizes.end(), starts.begin(), 0);
  return starts;
}
std::vector<std::size_t> starts_of(const std::vector<int>& rows, int width) {
  std::vector<std::size_t> starts{0};
  for (const int n : rows)
    starts.push_back(starts.back() + static_cast<std::size_t>(n) * static_cast<std::size_t>(width));
  return starts;
}

/// A rank's rows for itself never leave its memory.
void copy_own(const MessageBuffer& send, std::size_t from, const MessageBuffer& receive,
              std::size_t to, std::size_t n) {
  using Numbers = Kokkos::View<Real*, Kokkos::MemoryUnmanaged>;
  if (n > 0) Kokkos::deep_copy(Numbers(receive.data() + to, n), Numbers(send.data() + from, n));
}

}  // namespace

const MessageCounts& message_counts() { return sent_so_far; }

void exchange_detail::count_reduction() { ++sent_so_far.reductions; }

bool mpi_reaches_device() {
  if (runs_on_host) return true;
#if defined(MPIX_CUDA_AWARE_SUPPORT)
  return MPIX_Query_cuda_support() == 1;
#else
  return false;
#endif
}

MessageBuffer::MessageBuffer(std::string label, std::size_t n) : label_(std::move(label)) {
  reserve(n);
}

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

HaloBuffers::HaloBuffers(std::size_t n)
    : to_before("halo: to before", n),
      to_after("halo: to after", n),
      from_before("halo: from before", n),
      from_after("halo: from after", n) {}

void exchange(const RankLine& line, const HaloBuffers& buffers, std::size_t n_numbers) {
  constexpr int forth = 1, back = 2;
  const int n = static_cast<int>(n_numbers);
  std::array<MPI_Request, 4> requests;
  MPI_Irecv(buffers.from_before.to_receive(), n, MPI_DOUBLE, line.before(), forth,
            line.communicator, &requests[0]);
  MPI_Irecv(buffers.from_after.to_receive(), n, MPI_DOUBLE, line.after(), back, line.communicator,
            &requests[1]);
  MPI_Isend(buffers.to_after.to_send(), n, MPI_DOUBLE, line.after(), forth, line.communicator,
            &requests[2]);
  MPI_Isend(buffers.to_before.to_send(), n, MPI_DOUBLE, line.before(), back, line.communicator,
            &requests[3]);
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  buffers.from_before.received();
  buffers.from_after.received();
  count_message(n_numbers);
  count_message(n_numbers);
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
    if (place != line.place && n > 0) count_message(static_cast<std::size_t>(n));
  }
}

int ExchangeCounts::n_to() const { return std::accumulate(to.begin(), to.end(), 0); }
int ExchangeCounts::n_from() const { return std::accumulate(from.begin(), from.end(), 0); }

RowsByRank sort_by_rank(const Kokkos::View<int*>& rank, const Kokkos::View<int*>& row,
                        int n_ranks) {
  const auto rank_here = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, rank);
  const auto row_here = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, row);
  RowsByRank sorted{.row = Kokkos::View<int*>("rows by rank", row.extent(0)),
                    .to = std::vector<int>(static_cast<std::size_t>(n_ranks), 0)};
  const auto at = [&](std::size_t p) { return static_cast<std::size_t>(rank_here(p)); };
  for (std::size_t p = 0; p < row.extent(0); ++p) ++sorted.to[at(p)];
  std::vector<int> next = starts_of(sorted.to);
  const auto sorted_here = Kokkos::create_mirror_view(sorted.row);
  for (std::size_t p = 0; p < row.extent(0); ++p) sorted_here(next[at(p)]++) = row_here(p);
  Kokkos::deep_copy(sorted.row, sorted_here);
  return sorted;
}

ExchangeCounts exchange_counts(MPI_Comm ranks, std::vector<int> to) {
  ExchangeCounts counts{.ranks = ranks, .to = std::move(to), .from = {}};
  counts.from = counts.to;
  if (rank_count(ranks) == 1) return counts;
  MPI_Alltoall(counts.to.data(), 1, MPI_INT, counts.from.data(), 1, MPI_INT, ranks);
  ++sent_so_far.all_to_alls;
  return counts;
}

void exchange(const ExchangeCounts& counts, int width, const MessageBuffer& send,
              MessageBuffer& receive) {
  const auto to = starts_of(counts.to, width), from = starts_of(counts.from, width);
  receive.reserve(from.back());
  std::vector<MPI_Request> requests;
  const auto add = [&]() -> MPI_Request* { return &requests.emplace_back(); };
  const std::size_t n_ranks = counts.to.size(),
                    me = static_cast<std::size_t>(rank_of(counts.ranks));
  requests.reserve(2 * n_ranks);
  constexpr int tag = 3;
  Real* const incoming = receive.to_receive();
  for (std::size_t r = 0; r < n_ranks; ++r) {
    if (r == me || counts.from[r] == 0) continue;
    MPI_Irecv(incoming + from[r], counts.from[r] * width, MPI_DOUBLE, static_cast<int>(r), tag,
              counts.ranks, add());
  }
  const Real* const outgoing = send.to_send();
  for (std::size_t r = 0; r < n_ranks; ++r) {
    if (r == me || counts.to[r] == 0) continue;
    MPI_Isend(outgoing + to[r], counts.to[r] * width, MPI_DOUBLE, static_cast<int>(r), tag,
              counts.ranks, add());
    count_message(to[r + 1] - to[r]);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  receive.received();
  copy_own(send, to[me], receive, from[me], to[me + 1] - to[me]);
}

}  // namespace barchan
