// Action of the fluid on each grain over a fluid step, and the reaction of the grain.
#pragma once

#include "kernels/grains/clump.hpp"

namespace barchan {

/// Action of the fluid on the grains over the grain steps of a fluid step. All but `impulse` is
/// constant meanwhile.
struct FluidOnGrains {
  Kokkos::View<Vec3*> u_f;  // fluid velocity as the fluid step begins [m/s]
  // acceleration of the grain's share of fluid, by all but the grain [m/s^2]
  Kokkos::View<Vec3*> acceleration;
  Kokkos::View<Real*> inv_fluid_mass;   // 1 / mass of that share [1/kg]; 0: u_f does not change
  Kokkos::View<Real*> beta;             // [kg/s]
  Kokkos::View<Vec3*> explicit_force;   // weight, buoyancy, pressure gradient, ... [N]
  Kokkos::View<Real*> added_mass;       // [kg]
  Kokkos::View<Vec3*> impulse;          // impulse of drag and added mass on the grain so far [N s]
  Kokkos::View<Vec3*> u_start;          // velocity as the fluid step began [m/s]
  Kokkos::View<Vec3*> omega_f;          // half the vorticity of the fluid [rad/s]
  Kokkos::View<Real*> beta_r;           // torque = beta_r (omega_f - omega) [N m s]
  Kokkos::View<Vec3*> explicit_torque;  // torque of a resolved flow [N m]; else empty
  // spin as the fluid step began [rad/s], and its change over the one before [rad/s^2]; likewise
  Kokkos::View<Vec3*> spin_start, spin_acceleration;
  // of the clump that a sphere belongs to; empty: all grains are spheres
  Kokkos::View<PartOfClump*> part;
  bool has_fluid = false;    // without fluid, only explicit_force is set
  bool has_torque = false;   // torque of the fluid: omega_f and beta_r are set
  bool is_resolved = false;  // explicit_force and explicit_torque are all there is

  /// Velocity of the fluid that the grain carries along, `elapsed` [s] into the fluid step [m/s].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 u_f_after(Real elapsed, int g) const {
    return u_f(g) + elapsed * acceleration(g) - inv_fluid_mass(g) * impulse(g);
  }
  /// Radius of the grain that drag, lift and torque act on, as a sphere of its volume [m].
  KOKKOS_FORCEINLINE_FUNCTION Real radius(int g, const GrainKinematics& grain) const {
    return part.extent(0) > 0 ? part(g).d / 2 : grain.r;
  }
  /// Distance from the centre of an entry to its surface [m].
  KOKKOS_FORCEINLINE_FUNCTION Real to_surface(int g, const GrainKinematics& grain) const {
    return part.extent(0) > 0 ? part(g).radius : grain.r;
  }
  /// Share of an entry in its grain.
  KOKKOS_FORCEINLINE_FUNCTION Real share(int g) const {
    return part.extent(0) > 0 ? part(g).share : Real(1);
  }
};

/// Values that the gather keeps of each grain for the deposit and for output.
struct ExchangeOnGrains {
  Kokkos::View<Vec3*> added_mass_force;  // C_m rho V_p (u . grad u + a part of du/dt) [N]
  Kokkos::View<Vec3*> pressure_force;    // force of the pressure gradient [N]
  Kokkos::View<Vec3*> stress_force;      // force of the stress [N]
  Kokkos::View<Vec3*> lift;              // part of the steady force [N]; empty without lift
  // force of a resolved flow [N]; empty if the flow is unresolved
  Kokkos::View<Vec3*> resolved_force;
  Kokkos::View<Vec3*> resolved_torque;  // torque of a resolved flow about the centre [N m]
  // momentum [N s] and angular momentum [N m s] of the water inside; empty unless grains move in a
  // resolved flow
  Kokkos::View<Vec3*> inner_momentum, inner_spin;
};

/// Begins a fluid step: sets the impulse to zero and stores the velocities to compare with.
struct BeginFluidStep {
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  Kokkos::View<const ClumpMotion*> clump = {};  // empty: all grains are spheres
  KOKKOS_FUNCTION void operator()(int g) const {
    on_grains.impulse(g) = Vec3{};
    on_grains.u_start(g) = clump.extent(0) > 0 ? clump(g).u : grains(g).u;
    if (on_grains.is_resolved) on_grains.spin_start(g) = grains(g).omega;
  }
};

}  // namespace barchan
