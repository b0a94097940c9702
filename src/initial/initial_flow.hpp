// A flow to start from that soon becomes turbulent.
#pragma once

#include "src/config/config.hpp"
#include "src/fluid/fluid_state.hpp"

namespace barchan {

/// Sets the velocity to Reichardt's mean profile for the friction velocity expected at the bulk
/// velocity of t = 0, along that, scaled to it exactly, plus a divergence-free perturbation:
/// vortices near the walls and random oblique waves, together 10 % of the bulk velocity (RMS of the
/// three components). The vortices lie along x, or along z if the flow goes more along z. The same
/// `initial.seed` gives the same flow. Ghosts are not set. `config.fluid` must be there.
void set_turbulent_flow(const Config& config, FluidState& fluid);

/// Sets the velocity to the bulk velocity of t = 0 in every cell: the walls begin to slow
/// it in the first step, by the ghosts. Those are not set. `config.fluid` must be there.
void set_uniform_flow(const Config& config, FluidState& fluid);

}  // namespace barchan
