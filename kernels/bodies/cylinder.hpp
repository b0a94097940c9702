// A cylinder, upright or lying.
#pragma once

#include "kernels/bodies/shape.hpp"

namespace barchan::shapes {

/// Cylinder, upright with a height, or lying with its lowest line at y = 0. A lying one of half
/// length 0 has no ends.
struct Cylinder {
  static constexpr Named named{"cylinder", "upright, or lying along x or z"};
  Axis axis = Axis::y;
  Real radius = 0, height = 0, half_length = 0;

  static ShapeKeys keys(const auto& body) {
    if (body.axis == Axis::y) return {.needs = {"radius", "height"}, .takes = {"axis"}};
    return {.needs = {"radius"}, .takes = {"axis", "length"}};
  }
  static const char* words(const auto& body) {
    return body.axis == Axis::y ? "an upright cylinder" : "a lying cylinder";
  }
  static Cylinder from(const auto& body) {
    return {body.axis, body.radius, body.height, body.length / 2};
  }
  static Footprint footprint(const auto& body) {
    const Real r = body.radius, half = body.length / 2;
    return {.half_x = body.axis == Axis::x ? half : r,
            .half_z = body.axis == Axis::z ? half : r,
            .height = body.axis == Axis::y ? body.height : 2 * r,
            .narrowest = 2 * r};
  }

  KOKKOS_FORCEINLINE_FUNCTION static constexpr Real curvature() { return 0; }
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& p) const {
    if (axis == Axis::y) return upright(p);
    if (axis == Axis::x) return along_x(p);
    const ToSurface at = along_x({p.z, p.y, p.x});
    return {at.distance, {at.normal.z, at.normal.y, at.normal.x}};
  }
  KOKKOS_INLINE_FUNCTION ToSurface upright(const Vec3& p) const {
    const Real r = Kokkos::sqrt(p.x * p.x + p.z * p.z), up = p.y - height / 2;
    return to_corner<2>({r - radius, Kokkos::abs(up) - height / 2},
                        {away_from_axis(p.x, p.z, r), {0, sign_of(up), 0}});
  }
  KOKKOS_INLINE_FUNCTION ToSurface along_x(const Vec3& p) const {
    const Real y = p.y - radius, r = Kokkos::sqrt(y * y + p.z * p.z);
    const Vec3 out = r > 0 ? Vec3{0, y / r, p.z / r} : Vec3{0, 1, 0};
    if (half_length == 0) return {r - radius, out};
    return to_corner<2>({r - radius, Kokkos::abs(p.x) - half_length}, {out, {sign_of(p.x), 0, 0}});
  }
};

}  // namespace barchan::shapes
