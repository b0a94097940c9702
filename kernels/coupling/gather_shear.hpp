// Fluid to grain: lift and torque of the sheared flow on each grain, for one fluid step. Launched
// after the gather, and only if one of them acts.
#pragma once

#include "kernels/coupling/shear_forces.hpp"
#include "kernels/fluid/interpolation.hpp"
#include "kernels/grains/fluid_on_grains.hpp"

namespace barchan {

struct GatherShear {
  GridRef grid;
  PeriodicBox box;
  ConstFaceRef u;
  Real rho_f = 0, mu_f = 0;
  bool lift = false, torque = false;
  bool floor = false;  // no slip at y = 0
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    const Vec3 vorticity = interpolate_curl(u, grid, PointStencil(grid, box, grain.x));
    if (lift) {
      const Vec3 force = lift_on(grain, on_grains.u_f(g) - grain.u, vorticity);
      exchange.lift(g) = force;
      on_grains.steady_force(g) += force;
    }
    if (torque) {
      const Vec3 omega_f = Real(0.5) * vorticity;
      on_grains.omega_f(g) = omega_f;
      on_grains.beta_r(g) = rotational_drag(rho_f, mu_f, 2 * grain.r, norm(omega_f - grain.omega));
    }
  }

 private:
  /// [N], at the slip that the drag sees.
  KOKKOS_INLINE_FUNCTION Vec3 lift_on(const GrainKinematics& grain, const Vec3& slip,
                                      const Vec3& vorticity) const {
    const Real w = norm(vorticity);
    if (w == 0) return {};
    const Real above = floor ? grain.x.y - grain.r : Kokkos::Experimental::infinity_v<Real>;
    const Real k = lift_coefficient({.rho_f = rho_f,
                                     .mu_f = mu_f,
                                     .d_p = 2 * grain.r,
                                     .slip = norm(slip),
                                     .vorticity = w,
                                     .gap = above > 0 ? above : Real(0)});
    return (k / w) * cross(slip, vorticity);
  }
};

}  // namespace barchan
