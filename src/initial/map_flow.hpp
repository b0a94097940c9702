// Interpolation of a flow to another mesh.
#pragma once

#include <array>

#include "src/fluid/fluid_case.hpp"
#include "src/fluid/fluid_state.hpp"

namespace barchan {

/// Sets `to` to the flow of `from`, on another mesh of the same box, as mapFields of OpenFOAM does:
/// velocity, pressure, eddy viscosity and fluid fraction between nodes (FlowFromMesh). Then a
/// gradient takes away the divergence of alpha u, and the velocity is scaled to the bulk velocity
/// of `from`. `flow`: of `to`. `from` is whole on every rank and gets its ghosts here; those of
/// `to` are not set. All ranks call it together.
void map_flow(const FluidCase& flow, FluidState& from, FluidState& to);

/// The same where the box of `to` is a window of that of `from`, whose corner lies at [x, z] there
/// [m]. `theirs`: boundaries of `from`. The velocity is not scaled.
void map_window(const FluidCase& flow, const FluidConfig& theirs,
                const std::array<double, 2>& corner, FluidState& from, FluidState& to);

}  // namespace barchan
