// Grain as its neighbours see it, and the sum of its contact forces.
#pragma once

#include "kernels/math/vec4.hpp"

namespace barchan {

/// Values of a grain that contacts need, side by side in memory: two cache lines per neighbour
/// instead of eleven.
struct alignas(32) GrainKinematics {
  Vec3 x;         // centre [m]
  Real r = 0;     // radius [m]
  Vec3 u;         // velocity [m/s]
  Real m = 0;     // mass [kg]
  Vec3 omega;     // angular velocity [rad/s]
  Real skin = 0;  // distance that it may move until the neighbour list is searched again [m]

  KOKKOS_FORCEINLINE_FUNCTION Vec4 x_r() const { return {x.x, x.y, x.z, r}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec4 u_m() const { return {u.x, u.y, u.z, m}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec4 omega_skin() const { return {omega.x, omega.y, omega.z, skin}; }
};

/// Sum of the contact forces [N] and torques [N m] on a grain.
struct ContactSum {
  Vec4 force, torque;
};

}  // namespace barchan
