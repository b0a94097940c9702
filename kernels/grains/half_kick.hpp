// Half kick of a grain and the fluid that it carries along, with a drag that is linear in their
// slip. Equations: docs/theory-grains.md, "Integration".
#pragma once

#include "kernels/grains/fluid_on_grains.hpp"

namespace barchan {

/// Coefficients of the motion of a grain and its fluid, constant over a fluid step.
struct MotionCoefficients {
  Real mass = 0;            // mass of the grain [kg]
  Real inertia_moment = 0;  // [kg m^2]
  Real inv_fluid_mass = 0;  // 1 / mass of its share of fluid [1/kg]
  Real beta = 0;            // F_drag = beta (u_f - u) [kg/s]
  Real added_mass = 0;      // F = added_mass d(u_f - u)/dt [kg]
  Real beta_r = 0;          // T = beta_r (omega_f - omega) [N m s]
};

/// Forces on one grain over a grain step, and the motion of the fluid around it.
struct GrainForces {
  Vec3 force;         // all but drag and added mass [N]
  Vec3 torque;        // all but that of the fluid [N m]
  Vec3 u_f;           // velocity of the grain's share of fluid [m/s]
  Vec3 acceleration;  // acceleration of that share by all but the grain [m/s^2]
  Vec3 omega_f;       // angular velocity of the fluid [rad/s]
};

/// Factors of a half kick over h [s]. The end of one grain step and the start of the next have the
/// same. With m of the grain, m_f of its share of fluid, m_a the added mass and v = u_f - u:
///   m (u' - u) = h F + J,   m_f (u_f' - u_f) = h m_f a - J,   J = h beta v' + m_a (v' - v),
/// drag at the new slip, so stable at any step. Subtracted, with k = 1/m + 1/m_f:
///   (1 + k (m_a + h beta)) v' = (1 + k m_a) v + h (a - F/m).
/// Limits: beta = m_a = 0 is the plain kick; v = 0, F = 0, a = 0 stays so; 1/m_f = a = 0 is drag in
/// a flow that does not change.
struct HalfKick {
  Real h;
  MotionCoefficients of_grain;
  Real inv_mass, h_over_inertia, drag_and_added_mass, decay, gain;

  KOKKOS_FORCEINLINE_FUNCTION HalfKick(Real half_step, const MotionCoefficients& coefficients)
      : h(half_step),
        of_grain(coefficients),
        inv_mass(1 / of_grain.mass),
        h_over_inertia(h / (of_grain.inertia_moment + h * of_grain.beta_r)),
        drag_and_added_mass(of_grain.added_mass + h * of_grain.beta) {
    const Real k = inv_mass + of_grain.inv_fluid_mass, share = 1 / (1 + k * drag_and_added_mass);
    decay = (1 + k * of_grain.added_mass) * share;
    gain = h * share;
  }

  /// Kicks u, u_f of f and the spin; returns J, the impulse on the grain [N s].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(GrainForces& f, Vec3& u, Vec3& omega) const {
    const Vec3 slip = f.u_f - u, relative_acceleration = fma(-inv_mass, f.force, f.acceleration);
    const Vec3 impulse = fma(drag_and_added_mass, fma(decay, slip, gain * relative_acceleration),
                             -of_grain.added_mass * slip);
    f.u_f = fma(-of_grain.inv_fluid_mass, impulse, fma(h, f.acceleration, f.u_f));
    u = fma(inv_mass, fma(h, f.force, impulse), u);
    omega = fma(h_over_inertia, fma(of_grain.beta_r, f.omega_f - omega, f.torque), omega);
    return impulse;
  }
};

}  // namespace barchan
