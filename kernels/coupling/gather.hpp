// Fluid to grain: the forces of the flow on each grain, and those over the last fluid step taken
// apart for output. Equations: docs/model.md.
#pragma once

#include "kernels/coupling/drag.hpp"
#include "kernels/coupling/flow_at_grains.hpp"
#include "kernels/coupling/shear_forces.hpp"
#include "kernels/grains/half_kick.hpp"

namespace barchan {

inline constexpr Real kAddedMassCoefficient = 0.5;  // C_m of a sphere

/// C_m rho V [kg].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real sphere_added_mass(Real rho_f, Real volume) {
  return kAddedMassCoefficient * rho_f * volume;
}

/// Weight less buoyancy [N].
struct SubmergedWeight {
  Vec3 gravity;        // [m/s^2]
  Real displaced = 0;  // density of what a grain displaces [kg/m^3]; 0: no buoyancy
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const GrainKinematics& grain) const {
    return (grain.m - displaced * sphere_volume(grain.r)) * gravity;
  }
};

/// Part of du_dt with which a grain's share of fluid goes on from the last step, K/(1 + K), K =
/// (m_added + dt beta) over the mass of the share; the rest acts on the added mass alone. One where
/// grain and fluid are tied; none where the grain hardly moves the fluid, whose changes of one step
/// are noise as points of the grain cross cells.
KOKKOS_INLINE_FUNCTION Real lasting_part(Real per_fluid_mass, Real added_mass, Real dt_beta) {
  const Real tied = per_fluid_mass * (added_mass + dt_beta);
  return tied / (1 + tied);
}

/// Fluid velocity, drag coefficient and all steady forces at each grain, for one fluid step; and
/// the share of fluid that the grain carries through its sub-steps: what of the fluid around it is
/// its own if all grains take alike, alpha_f rho_f V_p/(1 - alpha_f), the solid before the
/// smoothing, in the fullest of the grain's cells. What acts on that share besides the grain is
/// taken from the last step, in which the fluid there changed by du_dt though it lost the impulse:
/// where nothing changes, it keeps its velocity (docs/numerics.md, "Dense beds"). In the first step
/// it is convection, and pressure gradient and stress where these act on the grains.
/// The drag coefficient is that of the slip at the start; the drag itself follows grain and share.
template <class DragLaw>
struct GatherFluid {
  DragLaw drag;
  Real rho_f = 0, mu_f = 0;
  Real dt = 0;
  SubmergedWeight weight;
  FluidForces forces;
  bool by_row = false;
  bool first = false;  // these grains have taken no impulse from this flow yet
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow_at;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    const Vec3 u_f = flow_at.u(g), u_grad_u = flow_at.u_grad_u(g);
    const Real volume = sphere_volume(grain.r);
    const Real added_mass = Real(forces.added_mass) * sphere_added_mass(rho_f, volume);

    const Real alpha = least_fraction(flow_at.alpha_f(g));
    // By row the law reads the fraction around the grain. Of the flow it knows the superficial slip
    // and takes alpha_f of the whole force (model A); both go with the fraction of the flow.
    const Real alpha_here = by_row ? least_fraction(flow_at.alpha_cells(g)) : alpha;
    const Real unsmoothing = alpha / alpha_here;
    const LocalFlow flow{.alpha_f = alpha_here,
                         .rho_f = rho_f,
                         .mu_f = mu_f,
                         .slip = unsmoothing * norm(u_f - grain.u),
                         .d_p = 2 * grain.r};
    Real beta = Real(forces.drag) * (unsmoothing * unsmoothing) * drag(flow);
    if (forces.wall_drag) beta *= floor_drag_factor(flow, grain.x.y - grain.r);
    const Real per_fluid_mass = flow_at.solid_per_fluid(g) / (rho_f * volume);
    const Vec3 lasting = lasting_part(per_fluid_mass, added_mass, dt * beta) * flow_at.du_dt(g);
    Vec3 added_mass_force = added_mass * (u_grad_u + flow_at.du_dt(g) - lasting);
    Vec3 acceleration = lasting + (per_fluid_mass / dt) * on_grains.impulse(g);
    if (first) {
      acceleration = (1 / rho_f) * (flow_at.pressure(g) + flow_at.stress(g)) - u_grad_u;
      added_mass_force = added_mass * u_grad_u;
    }
    on_grains.acceleration(g) = acceleration;
    on_grains.per_fluid_mass(g) = per_fluid_mass;
    on_grains.u_f(g) = u_f;
    on_grains.beta(g) = beta;
    on_grains.added_mass(g) = added_mass;
    exchange.pressure_force(g) = volume * flow_at.pressure(g);
    exchange.stress_force(g) = volume * flow_at.stress(g);
    exchange.added_mass_force(g) = added_mass_force;
    on_grains.steady_force(g) =
        weight(grain) + (exchange.pressure_force(g) + exchange.stress_force(g)) + added_mass_force;
  }
};

/// Still, unbounded fluid around grains without a flow solver: weight, buoyancy, Schiller-Naumann
/// drag, added mass. Without a fluid the weight alone.
struct GatherStillFluid {
  Real rho_f = 0, mu_f = 0;
  SubmergedWeight weight;
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    on_grains.steady_force(g) = weight(grain);
    if (on_grains.none) return;
    const LocalFlow flow{
        .alpha_f = 1, .rho_f = rho_f, .mu_f = mu_f, .slip = norm(grain.u), .d_p = 2 * grain.r};
    on_grains.u_f(g) = on_grains.acceleration(g) = Vec3{};
    on_grains.per_fluid_mass(g) = 0;
    on_grains.beta(g) = SchillerNaumann{}(flow);
    on_grains.added_mass(g) = sphere_added_mass(rho_f, sphere_volume(grain.r));
  }
};

/// Grains that do not move: the impulse of a whole fluid step, in one kick of infinite mass.
struct DragOnFrozenGrains {
  Real dt = 0;
  FluidOnGrains on_grains;
  KOKKOS_FUNCTION void operator()(int g) const {
    const Real infinity = Kokkos::Experimental::infinity_v<Real>;
    const HalfKick half_kick(dt, {.mass = infinity,
                                  .inertia_moment = infinity,
                                  .per_fluid_mass = on_grains.per_fluid_mass(g),
                                  .beta = on_grains.beta(g),
                                  .added_mass = on_grains.added_mass(g)});
    GrainForces f;
    f.u_f = on_grains.u_f_after(0, g), f.acceleration = on_grains.acceleration(g);
    Vec3 u, spin;
    on_grains.impulse(g) = half_kick(f, u, spin);
  }
};

/// Drag and added mass, means over the fluid step [N].
struct DragAndAddedMass {
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;  // empty in still fluid
  Real dt;
  Kokkos::View<Vec3*> drag, added_mass;
  KOKKOS_FUNCTION void operator()(int g) const {
    const Vec3 slip_before = on_grains.u_f(g) - on_grains.u_start(g);
    const Vec3 slip = on_grains.u_f_after(dt, g) - grains(g).u;
    const Vec3 of_change = (on_grains.added_mass(g) / dt) * (slip - slip_before);
    drag(g) = (1 / dt) * on_grains.impulse(g) - of_change;
    added_mass(g) = of_change;
    if (exchange.added_mass_force.extent(0) > 0) added_mass(g) += exchange.added_mass_force(g);
  }
};

/// Contact force of the last grain step and the fluid force of the fluid step [N].
struct ResultantForce {
  FluidOnGrains on_grains;
  Kokkos::View<const Vec3*> contact_force;
  Real dt;
  Kokkos::View<Vec3*> total;
  KOKKOS_FUNCTION void operator()(int g) const {
    total(g) = contact_force(g) + on_grains.steady_force(g);
    if (!on_grains.none) total(g) += (1 / dt) * on_grains.impulse(g);
  }
};

/// Change of momentum over the fluid step, divided by it [N].
struct MeanResultantForce {
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const Vec3*> u_start;
  Real dt;
  Kokkos::View<Vec3*> mean;
  KOKKOS_FUNCTION void operator()(int g) const {
    mean(g) = (grains(g).m / dt) * (grains(g).u - u_start(g));
  }
};

}  // namespace barchan
