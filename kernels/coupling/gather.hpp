// Fluid to grain: the forces of the flow on each grain, and those over the last fluid step taken
// apart for output. Equations: docs/model.md.
#pragma once

#include "kernels/coupling/drag.hpp"
#include "kernels/coupling/flow_at_grains.hpp"
#include "kernels/coupling/shear_forces.hpp"
#include "kernels/grains/fluid_on_grains.hpp"

namespace barchan {

inline constexpr Real kAddedMassCoefficient = 0.5;  // C_m of a sphere

/// C_m rho V [kg].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real sphere_added_mass(Real rho_f, Real volume) {
  return kAddedMassCoefficient * rho_f * volume;
}

/// Bounds of the grains' centres, without a lower one for the height [m].
struct ExtentOfGrains {
  Kokkos::View<const GrainKinematics*> grains;
  KOKKOS_FUNCTION void operator()(int g, Real& left, Real& right, Real& top, Real& front,
                                  Real& back) const {
    const Vec3& x = grains(g).x;
    left = Kokkos::fmin(left, x.x), right = Kokkos::fmax(right, x.x);
    top = Kokkos::fmax(top, x.y);
    front = Kokkos::fmin(front, x.z), back = Kokkos::fmax(back, x.z);
  }
};

/// Weight less buoyancy [N].
struct SubmergedWeight {
  Vec3 gravity;        // [m/s^2]
  Real displaced = 0;  // density of what a grain displaces [kg/m^3]; 0: no buoyancy
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const GrainKinematics& grain) const {
    return (grain.m - displaced * sphere_volume(grain.r)) * gravity;
  }
};

/// Share by which a grain's view of the flow follows the flow in one fluid step. The exchange lags
/// one step, and in a dense bed the pore water resists squeezing with beta/alpha^2 and the inertia
/// of the water that has to leave, r (1 + C_m r) of the grain's own volume of it, r = (1 -
/// alpha)/alpha. Where that exceeds the grain's inertia, following without relaxation overshoots
/// more each time (docs/numerics.md, "Dense beds"). About 1 in dilute flow; the delay vanishes with
/// the step.
KOKKOS_INLINE_FUNCTION Real exchange_relaxation(Real inertia, Real displaced_mass, Real beta,
                                                Real alpha_f, Real dt) {
  const Real r = (1 - alpha_f) / alpha_f;
  const Real squeezed = displaced_mass * r * (1 + kAddedMassCoefficient * r);
  return inertia / (inertia + squeezed + beta * dt / (alpha_f * alpha_f));
}

/// Fluid velocity, drag coefficient and all steady forces at each grain, for one fluid step.
/// The drag coefficient is that of the slip at the start; the drag itself follows the grain.
template <class DragLaw>
struct GatherFluid {
  DragLaw drag;
  GridRef grid;
  PeriodicBox box;
  ConstFaceRef convective;
  Real rho_f = 0, mu_f = 0, dt = 0;
  SubmergedWeight weight;
  FluidForces forces;
  bool skip_relaxation = false;  // the first step, grains that do not move
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow_at;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    const PointStencil at(grid, box, grain.x);
    const Vec3 u_f = flow_at.u(g);
    const Real volume = sphere_volume(grain.r);
    const Real added_mass = Real(forces.added_mass) * sphere_added_mass(rho_f, volume);
    const Vec3 added_mass_force = added_mass * interpolate_faces(convective, at);

    const Real alpha = in_range(flow_at.alpha_f(g));
    // By row the law reads the fraction around the grain. Of the flow it knows the superficial slip
    // and takes alpha_f of the whole force (model A); both go with the fraction of the flow.
    const bool by_row = flow_at.alpha_cells.extent(0) > 0;
    const Real alpha_here = by_row ? in_range(flow_at.alpha_cells(g)) : alpha;
    const Real unsmoothing = alpha / alpha_here;
    const LocalFlow flow{.alpha_f = alpha_here,
                         .rho_f = rho_f,
                         .mu_f = mu_f,
                         .slip = unsmoothing * norm(u_f - grain.u),
                         .d_p = 2 * grain.r};
    Real beta = Real(forces.drag) * (unsmoothing * unsmoothing) * drag(flow);
    if (forces.wall_drag) beta *= floor_drag_factor(flow, grain.x.y - grain.r);
    const Real share = skip_relaxation ? Real(1)
                                       : exchange_relaxation(grain.m + added_mass, rho_f * volume,
                                                             beta, alpha, dt);
    const auto follow = [&](Vec3& seen, const Vec3& now) { seen += share * (now - seen); };
    follow(on_grains.u_f(g), u_f);
    follow(exchange.pressure_force(g), volume * flow_at.pressure(g));
    follow(exchange.stress_force(g), volume * flow_at.stress(g));
    const Vec3 paid = share * exchange.carried_impulse(g);
    exchange.carried_impulse(g) = exchange.carried_impulse(g) - paid;

    on_grains.beta(g) = beta;
    on_grains.added_mass(g) = added_mass;
    on_grains.steady_force(g) = weight(grain) +
                                (exchange.pressure_force(g) + exchange.stress_force(g)) +
                                added_mass_force + (1 / dt) * paid;
    exchange.added_mass_force(g) = added_mass_force;
  }

 private:
  KOKKOS_INLINE_FUNCTION static Real in_range(Real alpha) {
    return Kokkos::clamp(alpha, Real(0.1), Real(1));
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
    on_grains.u_f(g) = Vec3{};
    on_grains.beta(g) = SchillerNaumann{}(flow);
    on_grains.added_mass(g) = sphere_added_mass(rho_f, sphere_volume(grain.r));
  }
};

/// Grains that do not move: the drag impulse of a whole fluid step.
struct DragOnFrozenGrains {
  Real dt = 0;
  FluidOnGrains on_grains;
  KOKKOS_FUNCTION void operator()(int g) const {
    on_grains.drag_impulse(g) = (dt * on_grains.beta(g)) * on_grains.u_f(g);
  }
};

/// (m_added / dt) (u - u_start): the force that the added mass took for its own change of
/// momentum [N].
KOKKOS_INLINE_FUNCTION Vec3 added_mass_inertia(const FluidOnGrains& on, int g, const Vec3& u,
                                               Real dt) {
  return (on.added_mass(g) / dt) * (u - on.u_start(g));
}

/// Drag, and added mass with the carried impulse [N].
struct DragAndAddedMass {
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  SubmergedWeight weight;
  ExchangeOnGrains exchange;  // empty in still fluid
  Real dt;
  Kokkos::View<Vec3*> drag, added_mass;
  KOKKOS_FUNCTION void operator()(int g) const {
    const Vec3 inertia = added_mass_inertia(on_grains, g, grains(g).u, dt);
    // Of the steady force: what is neither weight nor lift nor of the pressure gradient and stress.
    added_mass(g) = on_grains.steady_force(g) - weight(grains(g)) - inertia;
    if (exchange.pressure_force.extent(0) > 0)
      added_mass(g) = added_mass(g) - exchange.pressure_force(g) - exchange.stress_force(g);
    if (exchange.lift.extent(0) > 0) added_mass(g) = added_mass(g) - exchange.lift(g);
    drag(g) = (1 / dt) * on_grains.drag_impulse(g);
  }
};

/// Contact force of the last grain step and the fluid force of the fluid step [N].
struct ResultantForce {
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  Kokkos::View<const Vec3*> contact_force;
  Real dt;
  Kokkos::View<Vec3*> total;
  KOKKOS_FUNCTION void operator()(int g) const {
    total(g) = contact_force(g) + on_grains.steady_force(g);
    if (on_grains.none) return;
    const Vec3 inertia = added_mass_inertia(on_grains, g, grains(g).u, dt);
    total(g) += (1 / dt) * on_grains.drag_impulse(g) - inertia;
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
