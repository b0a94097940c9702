// Volume and moment of inertia of a sphere.
#pragma once

#include <numbers>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Volume of a sphere [m^3]; radius [m].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real sphere_volume(Real radius) {
  return Real(4) / 3 * std::numbers::pi_v<Real> * radius * radius * radius;
}
static_assert(sphere_volume(0.5) > 0.523598 && sphere_volume(0.5) < 0.523599);  // pi d^3 / 6

/// Moment of inertia of a solid sphere about its centre, 2/5 m r^2 [kg m^2].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real sphere_inertia(Real mass, Real radius) {
  return Real(0.4) * mass * radius * radius;
}

/// Added mass of a sphere that leaves a wall or an equal sphere which it touches, over the mass of
/// the water that it displaces: (3 zeta(3) - 2)/2, by images in potential flow.
inline constexpr Real kTouchingAddedMass = 0.803;

/// Moment of inertia that a grain in a resolved flow turns in a step beside its own: that of the
/// water which it displaces [kg m^2]. The shell of a cell's width that turns with the grain at once
/// has about as much.
KOKKOS_FORCEINLINE_FUNCTION constexpr Real added_inertia(Real added_mass, Real radius) {
  return sphere_inertia(added_mass / kTouchingAddedMass, radius);
}

}  // namespace barchan
