// The state of a run in restart files, bit for bit.
#pragma once

#include <filesystem>

#include "src/coupling/coupled_step.hpp"
#include "src/io/checkpoint.hpp"

namespace barchan {

/// Writes all of `state` that the next step depends on.
void save_state(CheckpointWriter& file, const SystemState& state, const CoupledStep& step);

/// Fills `state`, which has the grid and the rows of the file (grains_in_file), and
/// restores the neighbour list. Throws std::runtime_error if the file is of another mesh.
void load_state(const CheckpointReader& file, SystemState& state, CoupledStep& step);

/// Only the flow, as the start of another run on the same mesh.
void load_flow(const CheckpointReader& file, FluidState& fluid);

}  // namespace barchan
