// The state of a run in restart files, bit for bit. Any number of ranks can go on from a file; the
// same number goes on with the same bits. All functions: all ranks together.
#pragma once

#include <string>

#include "src/coupling/system_state.hpp"
#include "src/grains/neighbor_list.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

/// Writes all of `state` that the next step depends on. `list`: of its grains, if it has any.
void save_state(CheckpointWriter& file, const SystemState& state, const NeighborList* list);

/// Fills `state`, which has the grid and the entries of the file (grains_in_file), and
/// restores the neighbour list. Throws std::runtime_error if the file is of another mesh.
void load_state(const CheckpointReader& file, SystemState& state, NeighborList* list);

/// Reads the flow alone, as the start of another run on the same mesh.
void load_flow(const CheckpointReader& file, FluidState& fluid);

/// A field of the grid: the cells of all ranks with the ghosts around the whole domain; ghosts of
/// `f` must be valid as far as the next step reads them.
void save_field(CheckpointWriter& file, const std::string& name, const Grid& grid, const Field& f);
/// This rank's part of it, ghosts included.
void load_field(const CheckpointReader& file, const std::string& name, const Grid& grid,
                const Field& f);

}  // namespace barchan
