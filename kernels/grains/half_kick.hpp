// Half kick of a grain and the fluid that it carries along, with a drag that is linear in their
// slip. Equations: docs/numerics.md, "Grains".
#pragma once

#include "kernels/grains/fluid_on_grains.hpp"

namespace barchan {

/// Forces on one grain over a sub-step.
struct GrainForces {
  Quad force;               // all but drag and added mass [N]
  Quad torque;              // [N m]
  Quad u_f{};               // velocity of the grain's share of fluid [m/s]
  Quad acceleration{};      // of that share by all but the grain [m/s^2]
  Real per_fluid_mass = 0;  // 1 / its mass [1/kg]
  Real beta = 0;            // F_drag = beta (u_f - u) [kg/s]
  Real added_mass = 0;      // F = added_mass d(u_f - u)/dt [kg]
  Quad spin_f{};            // spin of the fluid [rad/s]
  Real beta_r = 0;          // T = beta_r (spin_f - omega) [N m s]
  bool in_fluid = false;    // otherwise there is neither drag nor added mass
  Real mass = 0;            // of the grain [kg]
  Real inertia_moment = 0;  // [kg m^2]

  /// What the fluid does to grain g, `elapsed` [s] into the fluid step.
  KOKKOS_FORCEINLINE_FUNCTION void add_fluid(const FluidOnGrains& fluid, Real elapsed, int g) {
    in_fluid = true;
    u_f = fluid.u_f_after(elapsed, g);
    acceleration = quad(fluid.acceleration(g));
    per_fluid_mass = fluid.per_fluid_mass(g);
    beta = fluid.beta(g);
    added_mass = fluid.added_mass(g);
    if (fluid.turns) spin_f = quad(fluid.spin_f(g)), beta_r = fluid.beta_r(g);
  }
};

/// Factors of a half kick over h [s], the same for the end of one sub-step and the start of the
/// next. With m of the grain, m_f of its share of fluid, m_a the added mass and s = u_f - u:
///   m (u' - u) = h F + J,   m_f (u_f' - u_f) = h m_f a - J,   J = h beta s' + m_a (s' - s),
/// drag at the new slip, so stable at any step. Subtracted, with k = 1/m + 1/m_f:
///   (1 + k (m_a + h beta)) s' = (1 + k m_a) s + h (a - F/m).
/// Limits: beta = m_a = 0 is the plain kick; s = 0, F = 0, a = 0 stays so; 1/m_f = a = 0 is drag in
/// a flow that does not change.
struct HalfKick {
  Real h, per_mass, per_moment;
  Real per_fluid_mass = 0, added_mass = 0, with_drag = 0, kept = 0, gained = 0;

  KOKKOS_FORCEINLINE_FUNCTION HalfKick(Real half_step, const GrainForces& f)
      : h(half_step),
        per_mass(1 / f.mass),
        per_moment(half_step / (f.inertia_moment + half_step * f.beta_r)) {
    if (!f.in_fluid) return;
    per_fluid_mass = f.per_fluid_mass;
    added_mass = f.added_mass;
    with_drag = added_mass + h * f.beta;
    const Real k = per_mass + per_fluid_mass, share = 1 / (1 + k * with_drag);
    kept = (1 + k * added_mass) * share;
    gained = h * share;
  }

  /// u, u_f of f and the spin after the kick; returns J, the impulse on the grain [N s].
  KOKKOS_FORCEINLINE_FUNCTION Quad operator()(GrainForces& f, Quad& u, Quad& omega) const {
    Quad impulse{};
    if (f.in_fluid) {
      const Quad slip = f.u_f - u, pull = fused(-per_mass, f.force, f.acceleration);
      impulse = fused(with_drag, fused(kept, slip, gained * pull), -added_mass * slip);
      f.u_f = fused(-per_fluid_mass, impulse, fused(h, f.acceleration, f.u_f));
    }
    u = fused(per_mass, fused(h, f.force, impulse), u);
    const Quad torque = f.beta_r > 0 ? fused(f.beta_r, f.spin_f - omega, f.torque) : f.torque;
    omega = fused(per_moment, torque, omega);
    return impulse;
  }
};

}  // namespace barchan
