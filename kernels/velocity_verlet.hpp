// Velocity Verlet with a drag that is linear in the grain's velocity.
#pragma once

#include "kernels/vec3.hpp"

namespace barchan {

/// Forces on one grain over a sub-step.
struct GrainForces {
  Vec3 force;           // all but drag [N]
  Vec3 torque;          // [N m]
  Vec3 u_f;             // fluid velocity at the grain [m/s]
  Real beta = 0;        // F_drag = beta (u_f - u) [kg/s]
  Real inertia_mass = 0;    // grain + added mass [kg]
  Real inertia_moment = 0;  // [kg m^2]
};

/// Half kick over h [s], drag at the new velocity (unconditionally stable):
///   (M + h beta) u' = M u + h (F + beta u_f).
/// Returns the drag impulse on the grain, h beta (u_f - u') [N s].
/// Limits: beta = 0 is the plain kick; u = u_f, F = 0 stays so.
KOKKOS_FORCEINLINE_FUNCTION Vec3 half_kick(Real h, const GrainForces& f, Vec3& u, Vec3& omega) {
  const Real h_beta = h * f.beta;
  const Vec3 gain = h * f.force + h_beta * (f.u_f - u);
  u += (1 / (f.inertia_mass + h_beta)) * gain;
  omega += (h / f.inertia_moment) * f.torque;
  return h_beta * (f.u_f - u);
}

}  // namespace barchan
