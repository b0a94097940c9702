// Start of MPI, by whoever owns main.
#pragma once

namespace barchan {

/// Starts MPI; other threads than the caller's make no calls. A process that no launcher started is
/// alone: Open MPI then gets no daemon, network or session folder. That saves 0.4 s a start, and
/// runs that start at the same moment cannot meet in that folder. Settings of the user stand.
void start_mpi(int* argc, char*** argv);

}  // namespace barchan
