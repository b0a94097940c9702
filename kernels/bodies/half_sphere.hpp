// The upper half of a sphere.
#pragma once

#include "kernels/bodies/shape.hpp"

namespace barchan::shapes {

/// Upper half of a sphere about the origin.
struct HalfSphere {
  static constexpr Named named{"half_sphere", "the upper half of a sphere"};
  Real radius = 0;

  static ShapeKeys keys(const auto&) { return {.needs = {"radius"}}; }
  static HalfSphere from(const auto& body) { return {body.radius}; }
  static Footprint footprint(const auto& body) {
    const Real r = body.radius;
    return {.half_x = r, .half_z = r, .height = r, .narrowest = 2 * r};
  }

  KOKKOS_FORCEINLINE_FUNCTION Real curvature() const { return radius; }
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& p) const {
    if (p.y < 0) {
      const Real r = Kokkos::sqrt(p.x * p.x + p.z * p.z);
      return to_corner<2>({r - radius, -p.y}, {away_from_axis(p.x, p.z, r), {0, -1, 0}});
    }
    const Real r = norm(p);
    if (-p.y > r - radius) return {-p.y, {0, -1, 0}};
    return {r - radius, r > 0 ? (1 / r) * p : Vec3{0, 1, 0}};
  }
};

}  // namespace barchan::shapes
