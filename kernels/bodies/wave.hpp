// A wavy floor.
#pragma once

#include <cmath>

#include "kernels/bodies/shape.hpp"

namespace barchan::shapes {

/// Crests `height` above troughs, one crest at x = 0. Exact as far from it as half its smallest
/// radius of curvature, farther to first order in the curvature.
struct Wave {
  static constexpr Named named{"wave", "a floor of sine shape along x"};
  Real height = 0, wavelength = 0;

  static ShapeKeys keys(const auto&) { return {.needs = {"height", "wavelength"}}; }
  static Wave from(const auto& body) { return {body.height, body.wavelength}; }
  static Footprint footprint(const auto& body) {
    return {.height = body.height, .narrowest = body.wavelength};
  }
  static ShapeFault misfit(const auto& body, Real lx) {
    const Real waves = lx / body.wavelength;
    if (std::abs(waves - std::round(waves)) <= 1e-6 * waves) return {};
    return {{"wavelength", "domain.size"},
            "must fit into the length of the domain, {:.4g} m, a whole number of times",
            lx};
  }

  KOKKOS_FORCEINLINE_FUNCTION static constexpr Real curvature() { return 0; }
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& p) const {
    const Real k = 2 * Real(3.141592653589793238) / wavelength, half = height / 2;
    const ToSurface near =
        to_hill(p.y, half * (1 + Kokkos::cos(k * p.x)), -half * k * Kokkos::sin(k * p.x), 0);
    if (Kokkos::abs(near.distance) * half * k * k > Real(0.5)) return near;
    Real x = p.x - near.distance * near.normal.x;  // x of the nearest point, by Newton's steps
    for (int n = 0; n < 4; ++n) {
      const Real f = half * (1 + Kokkos::cos(k * x)), slope = -half * k * Kokkos::sin(k * x);
      const Real curve = k * k * (half - f);
      x -= (x - p.x + (f - p.y) * slope) / (1 + slope * slope + (f - p.y) * curve);
    }
    const Real slope = -half * k * Kokkos::sin(k * x);
    const Vec3 n = to_hill(0, 0, slope, 0).normal;
    return {n.x * (p.x - x) + n.y * (p.y - half * (1 + Kokkos::cos(k * x))), n};
  }
};

}  // namespace barchan::shapes
