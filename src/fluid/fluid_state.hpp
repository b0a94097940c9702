// Everything the fluid remembers from one step to the next.
#pragma once

#include "src/parallel/grid.hpp"

namespace barchan {

/// Volume-averaged flow on the staggered grid. u is the interstitial velocity.
/// Ghosts of u, p, alpha_f and nu_t are valid between steps.
struct FluidState {
  Grid grid;
  FaceVector u;              // interstitial fluid velocity [m/s]
  Field p, p_previous;       // pressure without the hydrostatic and driving parts [Pa], n and n-1
  Field alpha_f;             // fluid volume fraction [-]
  Field alpha_f_previous;    // the same before the last deposit
  Field nu_t;                // eddy viscosity [m^2/s]
  FaceVector rate_previous;  // -div(alpha u u) + alpha div(tau)/rho at n-1 [m/s^2]
  FaceVector du_dt;          // change of u over the last step divided by it [m/s^2]
  Real drive = 0;            // driving body force per unit mass along x [m/s^2]
  bool has_history = false;  // rate_previous and p_previous hold a step for Adams-Bashforth
  Real dt_previous = 0;      // length of that step [s]
  Real time = 0;             // since the start [s]
  Real bulk_at_start = 0;    // bulk velocity a ramp of the drive starts from [m/s]
  Real flow_missed = 0;  // flow rate by which the last projection missed that of the drive [m^2/s]
};

/// Zero everywhere.
inline FaceVector make_faces(const char* label, const Grid& grid) {
  return {Field(label, grid), Field(label, grid), Field(label, grid)};
}

/// Zero everywhere, alpha_f one.
inline FluidState make_fluid_state(const Grid& grid) {
  FluidState s{.grid = grid,
               .u = make_faces("fluid: u", grid),
               .p = Field("fluid: p", grid),
               .p_previous = Field("fluid: p previous", grid),
               .alpha_f = Field("fluid: alpha_f", grid),
               .alpha_f_previous = Field("fluid: alpha_f previous", grid),
               .nu_t = Field("fluid: nu_t", grid),
               .rate_previous = make_faces("fluid: rate", grid),
               .du_dt = make_faces("fluid: du/dt", grid)};
  Kokkos::deep_copy(s.alpha_f.storage, Real(1));
  Kokkos::deep_copy(s.alpha_f_previous.storage, Real(1));
  return s;
}

}  // namespace barchan
