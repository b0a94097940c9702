// Every message of a step: exchanged and counted here.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "src/parallel/decomposition.hpp"

namespace barchan {

/// Of this rank since the program started.
struct MessageCounts {
  std::int64_t messages = 0;     // sent to another rank
  std::int64_t bytes = 0;        // in them
  std::int64_t reductions = 0;   // a few numbers summed or compared over all ranks
  std::int64_t all_to_alls = 0;  // a number told to every rank, and one by each; not in `messages`
};
const MessageCounts& message_counts();

namespace exchange_detail {
void count_reduction();
}  // namespace exchange_detail

/// True where MPI takes addresses of the default memory space: always on a CPU, on a device if the
/// MPI library says so. Otherwise messages pass through the host.
bool mpi_reaches_device();

/// Numbers that kernels write and MPI sends, or the other way round.
class MessageBuffer {
 public:
  MessageBuffer() = default;
  MessageBuffer(std::string label, std::size_t n);
  /// For kernels.
  Real* data() const { return numbers_.data(); }
  std::size_t size() const { return numbers_.extent(0); }
  /// Room for n numbers, or some more if it grows; then what it held is lost.
  void reserve(std::size_t n);

  /// For MPI: what kernels wrote, complete; and where to put what kernels will read.
  const Real* to_send() const;
  Real* to_receive() const;
  /// After to_receive() was filled.
  void received() const;

 private:
  std::string label_;
  Kokkos::View<Real*> numbers_;
  Kokkos::View<Real*, Kokkos::HostSpace> staged_;  // empty where MPI reaches the numbers
};

/// Messages to and from the two neighbours along a direction; none where it is not cut.
struct HaloBuffers {
  MessageBuffer to_before, to_after, from_before, from_after;

  HaloBuffers() = default;
  /// Room for n numbers in each.
  explicit HaloBuffers(std::size_t n);
  bool is_cut() const { return to_after.size() > 0; }
};
/// Sends n numbers to the rank before and as many to the one after, and receives theirs.
void exchange(const RankLine& line, const HaloBuffers& buffers, std::size_t n);

/// Block p of `send`, counts[p] numbers one after the other, goes to the p-th rank of the line.
void exchange_all(const RankLine& line, const MessageBuffer& send,
                  const std::vector<int>& send_counts, const MessageBuffer& receive,
                  const std::vector<int>& receive_counts);

/// Rows (of grains, ghosts, contacts) that this rank sends to each rank of a communicator, and
/// receives from it.
struct ExchangeCounts {
  MPI_Comm ranks = MPI_COMM_SELF;
  std::vector<int> to, from;

  int n_to() const;
  int n_from() const;
  /// The same rows sent back.
  ExchangeCounts back() const { return {ranks, from, to}; }
};

/// Rows in the order of the ranks that they go to, and how many go to each.
struct RowsByRank {
  Kokkos::View<int*> row;
  std::vector<int> to;
};
/// `rank` and `row` of what is sent. Sorted on the host: it is little.
RowsByRank sort_by_rank(const Kokkos::View<int*>& rank, const Kokkos::View<int*>& row, int n_ranks);

/// Tells each rank how many rows it will receive. All ranks together.
ExchangeCounts exchange_counts(MPI_Comm ranks, std::vector<int> to);

/// Sends rows of `width` numbers, those for rank 0 first, and receives those for this rank in the
/// order of their senders; `receive` grows as needed. Ranks without rows for each other exchange no
/// message; a rank's rows for itself are copied.
void exchange(const ExchangeCounts& counts, int width, const MessageBuffer& send,
              MessageBuffer& receive);

}  // namespace barchan
