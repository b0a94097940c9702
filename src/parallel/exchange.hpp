// Messages of a step, all exchanged and counted here.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "src/parallel/decomposition.hpp"

namespace barchan {

/// Counts of messages of this rank since the program started.
struct MessageCounts {
  std::int64_t messages = 0;     // sent to another rank
  std::int64_t bytes = 0;        // bytes in the messages
  std::int64_t reductions = 0;   // a few numbers summed or compared over all ranks
  std::int64_t all_to_alls = 0;  // a number told to every rank, and one by each; not in `messages`
};
const MessageCounts& message_counts();

/// Sums or compares numbers over ranks; the result is the same on all of them, and counts as one
/// reduction. T is Real or std::int64_t.
template <class T>
void all_reduce(MPI_Comm ranks, std::span<T> numbers, MPI_Op operation);

/// Buffer of numbers that kernels write and MPI sends, or the other way round.
class MessageBuffer {
 public:
  MessageBuffer() = default;
  MessageBuffer(std::string label, std::size_t n);
  /// Numbers of the buffer, for kernels.
  Real* data() const { return numbers_.data(); }
  std::size_t size() const { return numbers_.extent(0); }
  /// Makes room for n numbers, or some more if it grows; then its content is lost.
  void reserve(std::size_t n);

  /// Numbers of the buffer, for MPI: the first function gives what kernels wrote, complete; the
  /// second, the place for what kernels will read.
  const Real* to_send() const;
  Real* to_receive() const;
  /// Ends a receipt: call it after to_receive() was filled.
  void received() const;

 private:
  std::string label_;
  Kokkos::View<Real*> numbers_;
  Kokkos::View<Real*, Kokkos::HostSpace> staged_;  // empty where MPI reaches the numbers
};

/// Numbers [begin, begin + n) of a buffer that go to a rank, or come from it.
struct MessageBlock {
  int rank = 0;
  std::size_t begin = 0, n = 0;
};
/// Sends the blocks `to` and receives the blocks `from`. Several blocks for one rank arrive in the
/// order they are sent in; an empty one is no message, and a rank's block for itself is copied.
void exchange(MPI_Comm ranks, const MessageBuffer& send, std::span<const MessageBlock> to,
              const MessageBuffer& receive, std::span<const MessageBlock> from);

/// Blocks for each rank, of count[rank] entries of `width` numbers, one after the other.
std::vector<MessageBlock> consecutive_blocks(const std::vector<int>& count, int width);

/// Numbers of rows (of grains, ghosts, contacts) that this rank sends to each rank of a
/// communicator, and receives from it.
struct ExchangeCounts {
  MPI_Comm ranks = MPI_COMM_SELF;
  std::vector<int> to, from;

  int n_to() const;
  int n_from() const;
  /// Counts of the way back.
  ExchangeCounts back() const { return {ranks, from, to}; }
};

/// List of rows in the order of the ranks that they go to, then those that go nowhere, with the
/// number for each rank.
struct SendList {
  Kokkos::View<int*> entry;
  std::vector<int> to;
};
/// Sorts the entries 0 to n - 1 by `rank`, -1 for nowhere; entries that go to one rank keep their
/// order.
SendList sort_by_rank(const Kokkos::View<int*>& rank, int n, int n_ranks);

/// Tells each rank how many entries it will receive. All ranks call it together.
ExchangeCounts exchange_counts(MPI_Comm ranks, std::vector<int> to);

}  // namespace barchan
