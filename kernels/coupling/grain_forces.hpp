// The forces on each grain over the last fluid step, taken apart for output.
#pragma once

#include "kernels/coupling/gather.hpp"

namespace barchan {

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
  Kokkos::View<const Vec3*> fluid_force;  // of pressure gradient and stress; empty in still fluid
  Real dt;
  Kokkos::View<Vec3*> drag, added_mass;
  KOKKOS_FUNCTION void operator()(int g) const {
    const Vec3 inertia = added_mass_inertia(on_grains, g, grains(g).u, dt);
    // Of the steady force: what is neither weight nor of the pressure gradient and stress.
    added_mass(g) = on_grains.steady_force(g) - weight(grains(g)) - inertia;
    if (fluid_force.extent(0) > 0) added_mass(g) = added_mass(g) - fluid_force(g);
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
