// Slip of a contact of two grains in a grain step.
#pragma once

#include "kernels/grains/contact_law.hpp"

namespace barchan {

/// Slip velocity [m/s] in velocity Verlet, whose velocities are half a step of dt [s] older than
/// its positions. It is taken apart along the normal of that time, then turned into the plane of
/// the present `normal`, the direction of `separation` [m]. With the present normal alone a grain
/// that rolls between much larger ones takes a part of its approach for slip in every step, and
/// friction holds it there (Vyas et al. 2025). Limit dt -> 0: contact_slip().
KOKKOS_FORCEINLINE_FUNCTION Vec3 slip_half_a_step_ago(const Vec3& separation, const Vec3& normal,
                                                      const Vec3& velocity_difference,
                                                      const Vec3& arm_omega_sum, Real dt) {
  const Vec3 before = fma(-dt / 2, velocity_difference, separation);
  const Vec3 normal_then = (1 / norm(before)) * before;
  const Vec3 slip = contact_slip(velocity_difference, arm_omega_sum, normal_then);
  const Real v_n = dot(slip, normal_then);
  const Vec3 v_t = fma(-v_n, normal_then, slip);
  return fma(v_n - dot(v_t, normal), normal, v_t);
}

}  // namespace barchan
