// Fluid to grain: lift and torque of the sheared flow on each grain, for one fluid step. Launched
// after the gather, and only if one of them acts.
#pragma once

#include "kernels/coupling/flow_at_grains.hpp"
#include "kernels/coupling/shear_forces.hpp"

namespace barchan {

template <class Law>
struct GatherShear {
  Law law;
  Real rho_f = 0, mu_f = 0;
  bool lift = false, torque = false;
  bool floor = false;  // no slip at y = 0
  Kokkos::View<const GrainKinematics*> grains;
  FlowAtGrains flow_at;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(int g) const {
    GrainKinematics grain = grains(g);
    grain.r = on_grains.radius(g, grain);
    const Vec3 vorticity = flow_at.vorticity(g);
    const Real alpha = limited_fraction(flow_at.alpha_o(g));
    if (lift) {
      const Vec3 force =
          on_grains.share(g) * lift_on(g, grain, on_grains.u_f(g) - grain.u, vorticity, alpha);
      exchange.lift(g) = force;
      on_grains.explicit_force(g) += force;
    }
    if (torque) {
      const Vec3 omega_f = Real(0.5) * vorticity;
      on_grains.omega_f(g) = omega_f;
      on_grains.beta_r(g) = on_grains.share(g) * torque_among_grains(alpha) *
                            rotational_drag(rho_f, mu_f, 2 * grain.r, norm(omega_f - grain.omega));
    }
  }

 private:
  /// Lift [N] at the slip that the drag sees. Its ratio to the drag is that of a lone grain.
  KOKKOS_INLINE_FUNCTION Vec3 lift_on(int g, const GrainKinematics& grain, const Vec3& slip,
                                      const Vec3& vorticity, Real alpha) const {
    const Real w = norm(vorticity);
    if (w == 0) return {};
    const Real above = floor ? grain.x.y - on_grains.to_surface(g, grains(g))
                             : Kokkos::Experimental::infinity_v<Real>;
    const Real k = lift_coefficient({.rho_f = rho_f,
                                     .mu_f = mu_f,
                                     .d_p = 2 * grain.r,
                                     .slip = norm(slip),
                                     .vorticity = w,
                                     .gap = above > 0 ? above : Real(0)});
    return (drag_over_lone(grain, norm(slip), alpha) * k / w) * cross(slip, vorticity);
  }
  KOKKOS_INLINE_FUNCTION Real drag_over_lone(const GrainKinematics& grain, Real slip,
                                             Real alpha) const {
    LocalFlow flow{.alpha_f = 1, .rho_f = rho_f, .mu_f = mu_f, .slip = slip, .d_p = 2 * grain.r};
    const Real lone = law(flow);
    flow.alpha_f = alpha;
    const Real here = law(flow);
    return here > lone && lone > 0 ? here / lone : 1;
  }
};

}  // namespace barchan
