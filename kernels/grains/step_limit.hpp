// Longest step for which one mode of motion is stable.
#pragma once

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Longest stable step [s] of a mode of motion with stiffness `k` [N/m] and damping `gamma` [kg/s]
/// over an inertia `m` [kg]. The kicks take positions of now and velocities half a step old, so an
/// oscillation from step to step begins to grow where k dt^2 + 2 gamma dt = 4 m. Limits: 2
/// sqrt(m/k) without damping, 2 m / gamma without a spring.
KOKKOS_INLINE_FUNCTION Real stable_step(Real k, Real gamma, Real m) {
  return 4 * m / (gamma + Kokkos::sqrt(gamma * gamma + 4 * k * m));
}

/// Inertia of a sphere over its mass, against slip at its surface: 1 / (1 + m r^2 / I) = 2/7;
/// against its spin alone: I / (m r^2) = 2/5.
inline constexpr Real kSlipInertia = Real(2) / 7, kSpinInertia = Real(2) / 5;

/// Inertia of a body over its mass in a contact: against slip, and against its spin alone. Default:
/// that of a sphere.
struct InertiaInContacts {
  Real slip = kSlipInertia, spin = kSpinInertia;
};

}  // namespace barchan
