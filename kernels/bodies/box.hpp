// A box.
#pragma once

#include <cmath>

#include "kernels/bodies/shape.hpp"

namespace barchan::shapes {

/// Box of half sizes along x and z; 0: no sides there.
struct Box {
  static constexpr Named named{"box", "turned by `angle`, or through the whole domain"};
  Vec2 half;
  Real height = 0;

  static ShapeKeys keys(const auto&) { return {.needs = {"height"}, .takes = {"size", "angle"}}; }
  static Box from(const auto& body) { return {{body.size[0] / 2, body.size[1] / 2}, body.height}; }
  static Footprint footprint(const auto& body) {
    const Real c = std::abs(std::cos(body.angle)), s = std::abs(std::sin(body.angle));
    const auto [x, z] = body.size;
    return {.half_x = x > 0 ? (c * x + s * z) / 2 : 0,
            .half_z = z > 0 ? (s * x + c * z) / 2 : 0,
            .height = body.height,
            .narrowest = narrower(x, z)};
  }
  static ShapeFault fault(const auto& body) {
    if (body.angle == 0 || (body.size[0] > 0 && body.size[1] > 0)) return {};
    return {{"angle", "size"}, "must be absent for a box through the whole domain"};
  }

  KOKKOS_FORCEINLINE_FUNCTION static constexpr Real curvature() { return 0; }
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& p) const {
    const Real up = p.y - height / 2;
    const Real dx = half.x > 0 ? Kokkos::abs(p.x) - half.x : -height;
    const Real dz = half.z > 0 ? Kokkos::abs(p.z) - half.z : -height;
    return to_corner<3>({Kokkos::abs(up) - height / 2, dx, dz},
                        {{0, sign_of(up), 0}, {sign_of(p.x), 0, 0}, {0, 0, sign_of(p.z)}});
  }
};

}  // namespace barchan::shapes
