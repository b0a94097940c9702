// Grains without a flow solver: in still fluid, or in a vacuum.
#pragma once

#include "kernels/coupling/drag.hpp"
#include "kernels/coupling/sphere_in_fluid.hpp"
#include "kernels/grains/fluid_on_grains.hpp"
#include "kernels/grains/sphere.hpp"

namespace barchan {

/// Still, unbounded fluid around the grains: weight, buoyancy, Schiller-Naumann drag, added mass.
/// Where there is no fluid: weight alone.
struct GatherStillFluid {
  Real rho_f = 0, mu_f = 0;
  SubmergedWeight weight;
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    on_grains.explicit_force(g) = weight(grain);
    if (!on_grains.has_fluid) return;
    const LocalFlow flow{
        .alpha_f = 1, .rho_f = rho_f, .mu_f = mu_f, .slip = norm(grain.u), .d_p = 2 * grain.r};
    on_grains.u_f(g) = on_grains.acceleration(g) = Vec3{};
    on_grains.inv_fluid_mass(g) = 0;
    on_grains.beta(g) = SchillerNaumann{}(flow);
    on_grains.added_mass(g) = sphere_added_mass(rho_f, sphere_volume(grain.r));
  }
};

}  // namespace barchan
