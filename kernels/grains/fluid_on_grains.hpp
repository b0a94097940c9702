// What the fluid does to each grain over a fluid step, and what the grain gives back.
#pragma once

#include "kernels/grains/grain.hpp"

namespace barchan {

/// What acts on the grains besides contacts, constant over the sub-steps of a fluid step.
struct FluidOnGrains {
  Kokkos::View<Vec3*> u_f;           // [m/s]
  Kokkos::View<Real*> beta;          // [kg/s]
  Kokkos::View<Vec3*> steady_force;  // weight, buoyancy, pressure gradient, ... [N]
  Kokkos::View<Real*> added_mass;    // [kg]
  Kokkos::View<Vec3*> drag_impulse;  // sum over the sub-steps of the drag on the grain [N s]
  Kokkos::View<Vec3*> u_start;       // velocity as the fluid step began [m/s]
  Kokkos::View<Vec3*> spin_f;        // of the fluid, half its vorticity [rad/s]
  Kokkos::View<Real*> beta_r;        // torque = beta_r (spin_f - spin) [N m s]
  bool none = true;                  // no fluid: nothing but steady_force is there
  bool turns = false;                // the fluid exerts a torque: spin_f and beta_r are there
};

/// What the gather keeps of each grain for the deposit and for the next step.
struct ExchangeOnGrains {
  Kokkos::View<Vec3*> added_mass_force;  // convective part, C_m rho V_p (u . grad u) [N]
  Kokkos::View<Vec3*> pressure_force;   // of pressure gradient and stress, as the grain sees them,
  Kokkos::View<Vec3*> stress_force;     // relaxed [N]
  Kokkos::View<Vec3*> carried_impulse;  // still owed to the grain by the implicit drag [N s]
  Kokkos::View<Vec3*> lift;             // part of the steady force [N]; empty without lift
};

/// A new fluid step: no drag impulse yet, and the velocity to compare with.
struct BeginFluidStep {
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  KOKKOS_FUNCTION void operator()(int g) const {
    on_grains.drag_impulse(g) = Vec3{};
    on_grains.u_start(g) = grains(g).u;
  }
};

}  // namespace barchan
