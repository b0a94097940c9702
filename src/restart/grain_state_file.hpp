// The grains in restart files, bit for bit. All functions: all ranks together.
#pragma once

#include "src/grains/neighbor_list.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

/// The grains: entries of all ranks one after the other, contacts by the ids of their grains.
void save_grains(CheckpointWriter& file, const GrainState& grains, const NeighborList& list);

/// This rank's entries of a restart file without their history, to size the state: those it wrote
/// if as many ranks did, else an equal share.
GrainState grains_in_file(const CheckpointReader& file, MPI_Comm ranks);

/// Reads all that save_grains() wrote into `grains` from grains_in_file(). On another number of
/// ranks the neighbour list is built anew.
void load_grains(const CheckpointReader& file, GrainState& grains, NeighborList& list);

}  // namespace barchan
