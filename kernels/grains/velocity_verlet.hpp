// Velocity Verlet with a drag that is linear in the grain's velocity.
#pragma once

#include "kernels/grains/grain.hpp"

namespace barchan {

/// Forces on one grain over a sub-step.
struct GrainForces {
  Quad force;               // all but drag [N]
  Quad torque;              // [N m]
  Quad u_f{};               // fluid velocity at the grain [m/s]
  Real beta = 0;            // F_drag = beta (u_f - u) [kg/s]
  Real inertia_mass = 0;    // grain + added mass [kg]
  Real inertia_moment = 0;  // [kg m^2]
};

/// Factors of a half kick over h [s], the same for the end of one sub-step and the start of the
/// next.
struct HalfKick {
  Real h, h_beta, per_mass, per_moment;

  KOKKOS_FORCEINLINE_FUNCTION HalfKick(Real half_step, const GrainForces& f)
      : h(half_step),
        h_beta(half_step * f.beta),
        per_mass(1 / (f.inertia_mass + half_step * f.beta)),
        per_moment(half_step / f.inertia_moment) {}

  /// Drag at the new velocity (unconditionally stable):
  ///   (M + h beta) u' = M u + h (F + beta u_f).
  /// Returns the drag impulse on the grain, h beta (u_f - u') [N s].
  /// Limits: beta = 0 is the plain kick; u = u_f, F = 0 stays so.
  KOKKOS_FORCEINLINE_FUNCTION Quad operator()(const GrainForces& f, Quad& u, Quad& omega) const {
    u = fused(per_mass, fused(h, f.force, h_beta * (f.u_f - u)), u);
    omega = fused(per_moment, f.torque, omega);
    return h_beta * (f.u_f - u);
  }
};

}  // namespace barchan
