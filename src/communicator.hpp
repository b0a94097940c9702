// Size and rank that also answer before MPI_Init: a program without MPI is one rank.
#pragma once

#include <mpi.h>

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

}  // namespace barchan
