// Fluid to grain: what is constant for a grain over one fluid step. The symbols are those of
// docs/theory-coupling.md, "Dense beds" and "Exchange of momentum".
#pragma once

#include "kernels/coupling/drag.hpp"
#include "kernels/coupling/flow_at_grains.hpp"
#include "kernels/coupling/shape_drag.hpp"
#include "kernels/coupling/shear_forces.hpp"
#include "kernels/coupling/sphere_in_fluid.hpp"
#include "kernels/grains/sphere.hpp"

namespace barchan {

/// Inertial fraction K/(1 + K), K = (C_m rho_f V_p + beta_p dt)/m_f: the part of du/dt with which
/// the fluid that a grain carries along goes on from the last step. The rest acts on the added mass
/// alone. It is one where grain and fluid are tied. It is zero where the grain hardly moves the
/// fluid, whose changes of one step are noise as points of the grain cross cells.
KOKKOS_FORCEINLINE_FUNCTION Real inertial_fraction(Real m_f_inv, Real m_added, Real beta_dt) {
  const Real K = m_f_inv * (m_added + beta_dt);
  return K / (1 + K);
}

/// Forces that do not change in the fluid step: weight and buoyancy, F_p, F_tau, the steady part of
/// F_m [N].
KOKKOS_FORCEINLINE_FUNCTION Vec3 explicit_force(const SubmergedWeight& weight,
                                                const GrainKinematics& grain,
                                                const ExchangeOnGrains& exchange, int g) {
  return weight(grain) + (exchange.pressure_force(g) + exchange.stress_force(g)) +
         exchange.added_mass_force(g);
}

/// Gathers u_f, beta_p, m_f, a and the steady forces of each grain. beta_p is that of the slip at
/// the start of the step; the drag itself follows the grain and its share of fluid, m_f.
template <class Law>
struct GatherFluid {
  Law law;
  Real rho_f = 0, mu_f = 0;
  Real dt = 0;
  SubmergedWeight weight;
  FluidForces forces;
  ShapeFactor shape;
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow_at;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics& grain = grains(g);
    const Real volume = sphere_volume(grain.r);
    const Real beta = drag_coefficient(g, grain);
    const Real m_added = Real(forces.added_mass) * sphere_added_mass(rho_f, volume);
    // m_f = rho_f V_p alpha_f/(1 - alpha_l)
    const Real m_f_inv = flow_at.solid_per_fluid(g) / (rho_f * volume);
    // a = I_-/(m_f dt) + K/(1 + K) du/dt
    const Vec3 du_dt = flow_at.du_dt(g);
    const Vec3 inertial = inertial_fraction(m_f_inv, m_added, dt * beta) * du_dt;
    const Vec3 a = inertial + (m_f_inv / dt) * on_grains.impulse(g);

    on_grains.u_f(g) = flow_at.u(g);
    on_grains.acceleration(g) = a;
    on_grains.inv_fluid_mass(g) = m_f_inv;
    on_grains.beta(g) = beta;
    on_grains.added_mass(g) = m_added;
    exchange.pressure_force(g) = volume * flow_at.pressure(g);
    exchange.stress_force(g) = volume * flow_at.stress(g);
    // C_m rho_f V_p (u . grad u + 1/(1 + K) du/dt)
    exchange.added_mass_force(g) = m_added * (flow_at.u_grad_u(g) + du_dt - inertial);
    on_grains.explicit_force(g) = explicit_force(weight, grain, exchange, g);
  }

 private:
  KOKKOS_INLINE_FUNCTION Real drag_coefficient(int g, const GrainKinematics& grain) const {
    const LocalFlow flow{.alpha_f = limited_fraction(flow_at.alpha_l(g)),
                         .rho_f = rho_f,
                         .mu_f = mu_f,
                         .slip = flow_at.slip(g),
                         .d_p = 2 * on_grains.radius(g, grain)};
    Real beta = Real(forces.drag) * flow_at.factor(g) * law(flow);
    if (on_grains.part.extent(0) > 0) {
      const PartOfClump part = on_grains.part(g);
      beta *= part.share * shape(flow, part, flow_at.u(g) - grain.u);
    }
    return forces.wall_drag
               ? beta * floor_drag_factor(flow, grain.x.y - on_grains.to_surface(g, grain))
               : beta;
  }
};

/// Replaces, after GatherFluid in the first step of a run, the terms that need I_- and du/dt, which
/// are not there yet: a is that of pressure gradient, stress and convection alone.
struct GatherFirstStep {
  Real rho_f = 0;
  SubmergedWeight weight;
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow_at;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(int g) const {
    const Vec3 u_grad_u = flow_at.u_grad_u(g);
    const Vec3 a = (1 / rho_f) * (flow_at.pressure(g) + flow_at.stress(g)) - u_grad_u;
    on_grains.acceleration(g) = a;
    exchange.added_mass_force(g) = on_grains.added_mass(g) * u_grad_u;
    on_grains.explicit_force(g) = explicit_force(weight, grains(g), exchange, g);
  }
};

}  // namespace barchan
