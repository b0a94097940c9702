#include "src/parallel/exchange.hpp"

#if __has_include(<mpi-ext.h>)
#include <mpi-ext.h>
#endif

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

#include "src/parallel/communicator.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

MessageCounts sent_so_far;

/// Tells if MPI takes addresses of the default memory space: always on a CPU, on a device if the
/// MPI library says so. Otherwise messages pass through the host.
bool mpi_reaches_device() {
  if (kOnHost) return true;
#if defined(MPIX_CUDA_AWARE_SUPPORT)
  return MPIX_Query_cuda_support() == 1;
#else
  return false;
#endif
}

}  // namespace

const MessageCounts& message_counts() { return sent_so_far; }

template <class T>
void all_reduce(MPI_Comm ranks, std::span<T> numbers, MPI_Op operation) {
  if (rank_count(ranks) == 1) return;
  ++sent_so_far.reductions;
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()),
                std::is_integral_v<T> ? MPI_INT64_T : MPI_DOUBLE, operation, ranks);
}
template void all_reduce(MPI_Comm, std::span<Real>, MPI_Op);
template void all_reduce(MPI_Comm, std::span<std::int64_t>, MPI_Op);

MessageBuffer::MessageBuffer(std::string label, std::size_t n) : label_(std::move(label)) {
  reserve(n);
}

void MessageBuffer::reserve(std::size_t n) {
  if (n <= size()) return;
  const std::size_t room = size() == 0 ? n : n + n / 8;
  numbers_ = Kokkos::View<Real*>(label_, room);
  if (!mpi_reaches_device())
    staged_ = Kokkos::View<Real*, Kokkos::HostSpace>("host: " + label_, room);
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

void exchange(MPI_Comm ranks, const MessageBuffer& send, std::span<const MessageBlock> to,
              const MessageBuffer& receive, std::span<const MessageBlock> from) {
  constexpr int tag = 3;
  const int me = rank_of(ranks);
  const auto travels = [me](const MessageBlock& block) { return block.rank != me && block.n > 0; };
  std::vector<MPI_Request> requests;
  requests.reserve(to.size() + from.size());
  Real* const incoming = receive.to_receive();
  for (const MessageBlock& block : from) {
    if (!travels(block)) continue;
    MPI_Irecv(incoming + block.begin, static_cast<int>(block.n), MPI_DOUBLE, block.rank, tag, ranks,
              &requests.emplace_back());
  }
  const Real* const outgoing = send.to_send();
  for (const MessageBlock& block : to) {
    if (!travels(block)) continue;
    MPI_Isend(outgoing + block.begin, static_cast<int>(block.n), MPI_DOUBLE, block.rank, tag, ranks,
              &requests.emplace_back());
    ++sent_so_far.messages;
    sent_so_far.bytes += static_cast<std::int64_t>(block.n * sizeof(Real));
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  receive.received();
  const auto sent = std::ranges::find(to, me, &MessageBlock::rank);
  if (sent == to.end() || sent->n == 0) return;
  const auto kept = std::ranges::find(from, me, &MessageBlock::rank);
  using Numbers = Kokkos::View<Real*, Kokkos::MemoryUnmanaged>;
  Kokkos::deep_copy(Numbers(receive.data() + kept->begin, kept->n),
                    Numbers(send.data() + sent->begin, sent->n));
}

std::vector<MessageBlock> consecutive_blocks(const std::vector<int>& count, int width) {
  std::vector<MessageBlock> blocks;
  std::size_t begin = 0;
  for (const int n : count) {
    const auto numbers = static_cast<std::size_t>(n) * static_cast<std::size_t>(width);
    blocks.push_back({.rank = static_cast<int>(blocks.size()), .begin = begin, .n = numbers});
    begin += numbers;
  }
  return blocks;
}

int ExchangeCounts::n_to() const { return std::accumulate(to.begin(), to.end(), 0); }
int ExchangeCounts::n_from() const { return std::accumulate(from.begin(), from.end(), 0); }

SendList sort_by_rank(const Kokkos::View<int*>& rank, int n, int n_ranks) {
  const Kokkos::View<int*> entry("entries by rank", static_cast<std::size_t>(n));
  const Kokkos::View<int*> count("entries of a rank", static_cast<std::size_t>(n_ranks));
  Kokkos::parallel_for(
      "entries by rank: count", items(n), KOKKOS_LAMBDA(int p) {
        if (rank(p) >= 0) Kokkos::atomic_inc(&count(rank(p)));
      });
  const auto to = host_copy(count);
  int begin = 0;
  for (int r = 0; r <= n_ranks && begin < n; ++r) {
    const int wanted = r < n_ranks ? r : -1, first = begin;
    if (wanted >= 0 && to(wanted) == 0) continue;
    Kokkos::parallel_scan(
        "entries by rank: list", items(n), KOKKOS_LAMBDA(int p, int& sum, bool final) {
          if (rank(p) != wanted) return;
          if (final) entry(first + sum) = p;
          ++sum;
        });
    if (wanted >= 0) begin += to(wanted);
  }
  return {.entry = entry, .to = {to.data(), to.data() + n_ranks}};
}

ExchangeCounts exchange_counts(MPI_Comm ranks, std::vector<int> to) {
  ExchangeCounts counts{.ranks = ranks, .to = std::move(to), .from = {}};
  counts.from = counts.to;
  if (rank_count(ranks) == 1) return counts;
  MPI_Alltoall(counts.to.data(), 1, MPI_INT, counts.from.data(), 1, MPI_INT, ranks);
  ++sent_so_far.all_to_alls;
  return counts;
}

}  // namespace barchan
