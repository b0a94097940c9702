// A sphere.
#pragma once

#include "kernels/bodies/shape.hpp"

namespace barchan::shapes {

struct Sphere {
  static constexpr Named named{"sphere", "its lowest point at `base`"};
  Real radius = 0;

  static ShapeKeys keys(const auto&) { return {.needs = {"radius"}}; }
  static Sphere from(const auto& body) { return {body.radius}; }
  static Footprint footprint(const auto& body) {
    const Real r = body.radius;
    return {.half_x = r, .half_z = r, .height = 2 * r, .narrowest = 2 * r};
  }

  KOKKOS_FORCEINLINE_FUNCTION Real curvature() const { return radius; }
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& p) const {
    const Vec3 s{p.x, p.y - radius, p.z};
    const Real r = norm(s);
    return {r - radius, r > 0 ? (1 / r) * s : Vec3{0, 1, 0}};
  }
};

}  // namespace barchan::shapes
