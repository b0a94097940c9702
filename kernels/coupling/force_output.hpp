// Forces on the grains over the last fluid step, taken apart for output.
#pragma once

#include "kernels/grains/fluid_on_grains.hpp"

namespace barchan {

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

/// Torque of the flow at the end of the fluid step [N m].
struct TorqueOfFlow {
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  Kokkos::View<Vec3*> torque;
  KOKKOS_FUNCTION void operator()(int g) const {
    torque(g) = on_grains.beta_r(g) * (on_grains.omega_f(g) - grains(g).omega);
  }
};

/// Contact force of the last grain step and the fluid force of the fluid step [N].
struct ResultantForce {
  FluidOnGrains on_grains;
  Kokkos::View<const Vec3*> contact_force;
  Real dt;
  Kokkos::View<Vec3*> total;
  KOKKOS_FUNCTION void operator()(int g) const {
    total(g) = contact_force(g) + on_grains.explicit_force(g);
    if (on_grains.has_fluid) total(g) += (1 / dt) * on_grains.impulse(g);
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
