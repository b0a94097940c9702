// Records of words between any ranks: grains that move, ghosts, visitors.
#pragma once

#include <mpi.h>

#include <vector>

#include "src/parallel/messages.hpp"

namespace barchan {

/// Records that this rank sends to each rank of a communicator, and gets from it.
struct RecordCounts {
  MPI_Comm ranks = MPI_COMM_SELF;
  std::vector<int> to, from;

  int n_to() const;
  int n_from() const;
  /// The same counts the other way round.
  RecordCounts back() const { return {ranks, from, to}; }
};

/// Tells each rank how many records it will get. All ranks together.
RecordCounts announce(MPI_Comm ranks, std::vector<int> to);

/// Sends records of `width` words, those for rank 0 first, and takes those for this rank in the
/// order of their senders; `receive` is given room. Ranks with nothing to tell each other do not
/// talk; a rank's records for itself are copied.
void exchange(const RecordCounts& counts, int width, const MessageBuffer& send,
              MessageBuffer& receive);

}  // namespace barchan
