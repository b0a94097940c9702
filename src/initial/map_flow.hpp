// The flow of one mesh on another.
#pragma once

#include "src/fluid/fluid_case.hpp"
#include "src/fluid/fluid_state.hpp"

namespace barchan {

/// Sets `to` to the flow of `from`, on another mesh of the same box, as mapFields of OpenFOAM does:
/// velocity, pressure, eddy viscosity and fluid fraction between nodes (FlowFromMesh). Then the
/// divergence of alpha u is taken away by a gradient, and the velocity is scaled to the bulk
/// velocity of `from`. `config`: of `to`. `from` is whole on every rank and gets its ghosts here;
/// those of `to` are not set. All ranks together.
void map_flow(const FluidCase& flow, FluidState& from, FluidState& to);

}  // namespace barchan
