// Measures of a flow for reports.
#pragma once

#include "src/fluid/fluid_case.hpp"
#include "src/fluid/fluid_state.hpp"

namespace barchan {

/// sum(alpha u V) / sum(alpha V) along x [m/s].
Real bulk_velocity(const FluidState& fluid);
/// sum(alpha w V) / sum(alpha V) along z [m/s].
Real bulk_velocity_across(const FluidState& fluid);

/// sqrt(nu |mean dU/dy|) over the walls without slip [m/s]; 0 if there are none. Of a flow that is
/// never driven along z, dU/dy is that along x.
Real friction_velocity(const FluidState& fluid, const FluidConfig& config, bool driven_across);
/// sum(rho alpha |u|^2 V) / 2 [J].
Real kinetic_energy(const FluidState& fluid, Real density);

}  // namespace barchan
