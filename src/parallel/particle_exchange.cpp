#include "src/parallel/particle_exchange.hpp"

#include <numeric>
#include <utility>

#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

std::vector<std::size_t> starts_of(const std::vector<int>& counts, int width) {
  std::vector<std::size_t> starts{0};
  for (const int n : counts)
    starts.push_back(starts.back() + static_cast<std::size_t>(n) * static_cast<std::size_t>(width));
  return starts;
}

/// A rank's records for itself never leave its memory.
void copy_own(const MessageBuffer& send, std::size_t from, const MessageBuffer& receive,
              std::size_t to, std::size_t n) {
  using Words = Kokkos::View<Real*, Kokkos::MemoryUnmanaged>;
  if (n > 0) Kokkos::deep_copy(Words(receive.data() + to, n), Words(send.data() + from, n));
}

}  // namespace

int RecordCounts::n_to() const { return std::accumulate(to.begin(), to.end(), 0); }
int RecordCounts::n_from() const { return std::accumulate(from.begin(), from.end(), 0); }

RecordCounts announce(MPI_Comm ranks, std::vector<int> to) {
  RecordCounts counts{.ranks = ranks, .to = std::move(to), .from = {}};
  counts.from = counts.to;
  if (rank_count(ranks) == 1) return counts;
  MPI_Alltoall(counts.to.data(), 1, MPI_INT, counts.from.data(), 1, MPI_INT, ranks);
  message_detail::count_all_to_all();
  return counts;
}

void exchange(const RecordCounts& counts, int width, const MessageBuffer& send,
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
    message_detail::count_message(to[r + 1] - to[r]);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  receive.received();
  copy_own(send, to[me], receive, from[me], to[me + 1] - to[me]);
}

}  // namespace barchan
