// Grains without a flow solver: in still fluid, or in a vacuum.
#pragma once

#include "kernels/coupling/shape_drag.hpp"
#include "kernels/coupling/sphere_in_fluid.hpp"
#include "kernels/grains/clump_motion.hpp"
#include "kernels/grains/fluid_on_grains.hpp"
#include "kernels/grains/sphere.hpp"

namespace barchan {

/// Still, unbounded fluid around the grains: weight, buoyancy, Schiller-Naumann drag, added mass.
/// Where there is no fluid: weight alone. A clump has the drag of its shape, the rest of the sphere
/// of its volume; all acts on its first sphere.
struct GatherStillFluid {
  Real rho_f = 0, mu_f = 0;
  SubmergedWeight weight;
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  ClumpsOfGrains clumps = {};                 // no motion: all grains are spheres
  Kokkos::View<const std::int64_t*> id = {};  // read with clumps

  KOKKOS_FUNCTION void operator()(int g) const {
    GrainKinematics grain = grains(g);
    const bool is_clump = clumps.motion.extent(0) > 0;
    if (is_clump) {
      if (member_of_id(id(g)) > 0) return clear(g);
      grain.r = clumps.motion(g).d / 2, grain.u = clumps.motion(g).u;
    }
    on_grains.explicit_force(g) = weight(grain);
    if (!on_grains.has_fluid) return;
    const LocalFlow flow{
        .alpha_f = 1, .rho_f = rho_f, .mu_f = mu_f, .slip = norm(grain.u), .d_p = 2 * grain.r};
    on_grains.u_f(g) = on_grains.acceleration(g) = Vec3{};
    on_grains.inv_fluid_mass(g) = 0;
    on_grains.beta(g) = SchillerNaumann{}(flow);
    if (is_clump) {
      const PartOfClump whole = clumps.part(clumps.motion(g), clumps.kind_of(g), 0);
      on_grains.beta(g) *= ShapeFactor{}(flow, whole, grain.u);
    }
    on_grains.added_mass(g) = sphere_added_mass(rho_f, sphere_volume(grain.r));
  }

  /// Leaves a sphere of a clump to its contacts.
  KOKKOS_FUNCTION void clear(int g) const {
    on_grains.explicit_force(g) = Vec3{};
    if (!on_grains.has_fluid) return;
    on_grains.u_f(g) = on_grains.acceleration(g) = Vec3{};
    on_grains.inv_fluid_mass(g) = on_grains.beta(g) = on_grains.added_mass(g) = 0;
  }
};

}  // namespace barchan
