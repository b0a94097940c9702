// Size and rank of a communicator, also before MPI_Init: a program without MPI is one rank.
#pragma once

#include <mpi.h>

#include <chrono>
#include <thread>
#include <vector>

namespace barchan {

inline bool mpi_runs() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started != 0 && ended == 0;
}

inline int rank_count(MPI_Comm communicator) {
  int count = 1;
  if (mpi_runs()) MPI_Comm_size(communicator, &count);
  return count;
}

inline int rank_of(MPI_Comm communicator) {
  int rank = 0;
  if (mpi_runs()) MPI_Comm_rank(communicator, &rank);
  return rank;
}

/// Waits for all ranks.
inline void synchronise(MPI_Comm communicator) {
  if (mpi_runs()) MPI_Barrier(communicator);
}

/// Waits for all ranks; false if one has not come here after this time: it is elsewhere, and the
/// program must end.
inline bool all_come(MPI_Comm communicator, std::chrono::milliseconds patience) {
  if (!mpi_runs()) return true;
  constexpr std::chrono::milliseconds pause{1};
  MPI_Request arrival = MPI_REQUEST_NULL;
  MPI_Ibarrier(communicator, &arrival);
  int here = 0;
  for (std::chrono::milliseconds waited{0}; here == 0 && waited < patience; waited += pause) {
    MPI_Test(&arrival, &here, MPI_STATUS_IGNORE);
    if (here == 0) std::this_thread::sleep_for(pause);
  }
  return here != 0;
}

/// Answer of rank 0, on all ranks: for questions to the clock or the disk that they might answer
/// differently.
inline bool broadcast(bool answer, MPI_Comm communicator) {
  int said = answer ? 1 : 0;
  if (mpi_runs()) MPI_Bcast(&said, 1, MPI_INT, 0, communicator);
  return said != 0;
}

inline std::vector<double> broadcast(std::vector<double> numbers, MPI_Comm communicator) {
  if (!mpi_runs()) return numbers;
  int n = static_cast<int>(numbers.size());
  MPI_Bcast(&n, 1, MPI_INT, 0, communicator);
  numbers.resize(static_cast<std::size_t>(n));
  MPI_Bcast(numbers.data(), n, MPI_DOUBLE, 0, communicator);
  return numbers;
}

/// Tells if the answer is yes on any rank, the same on all.
inline bool any_rank(bool answer, MPI_Comm communicator) {
  int said = answer ? 1 : 0;
  if (mpi_runs()) MPI_Allreduce(MPI_IN_PLACE, &said, 1, MPI_INT, MPI_MAX, communicator);
  return said != 0;
}

}  // namespace barchan
