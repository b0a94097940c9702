// Start flows that are not in a file.
#pragma once

#include "src/case/settled.hpp"
#include "src/fluid/fluid_state.hpp"

namespace barchan {

/// Sets the velocity to Reichardt's mean profile for the friction velocity expected at the bulk
/// velocity of t = 0, along that velocity and scaled to it exactly, plus a divergence-free
/// perturbation: vortices near the walls and random oblique waves, together 10 % of the bulk
/// velocity (RMS of the three components). The vortices lie along x, or along z if the flow goes
/// more along z. The same `initial.seed` gives the same flow. Ghosts are not set. The case must
/// have a flow.
void set_flow(TurbulentFlow, const SettledCase& the_case, FluidState& fluid);

/// Leaves the flow at rest, as a new state is.
inline void set_flow(StillFlow, const SettledCase&, FluidState&) {}

/// Sets the velocity to the bulk velocity of t = 0 in every cell: the walls begin to slow
/// it in the first step, by the ghosts. Those are not set. The case must have a flow.
void set_flow(UniformFlow, const SettledCase& the_case, FluidState& fluid);

}  // namespace barchan
