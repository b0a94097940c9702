// What ranks tell each other: every message of a step goes through here and is counted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/fluid/grid.hpp"
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

namespace message_detail {
/// One more of this rank: a message of so many words, or what all ranks take part in.
void count_message(std::size_t words);
void count_reduction();
void count_all_to_all();
}  // namespace message_detail

/// True where MPI takes addresses of the default memory space: always on a CPU, on a device if the
/// MPI library says so. Otherwise messages pass through the host.
bool mpi_reaches_device();

/// Numbers that kernels write and MPI sends, or the other way round.
class MessageBuffer {
 public:
  MessageBuffer() = default;
  MessageBuffer(const char* label, std::size_t n);
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

/// Sends a rim to the rank before and one to the rank after, and takes theirs.
struct Rims {
  MessageBuffer to_before, to_after, from_before, from_after;
};
void exchange(const RankLine& line, const Rims& rims);

/// Piece p of `send`, counts[p] numbers one after the other, goes to the rank at place p of the
/// line.
void exchange_all(const RankLine& line, const MessageBuffer& send,
                  const std::vector<int>& send_counts, const MessageBuffer& receive,
                  const std::vector<int>& receive_counts);

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

}  // namespace barchan
