// A fence.
#pragma once

#include <cmath>

#include "kernels/bodies/cylinder.hpp"
#include "kernels/bodies/shape.hpp"

namespace barchan::shapes {

/// Upright cylinders in a row along z, `posts` of them, `spacing` apart, the row centred.
struct Fence {
  static constexpr Named named{"fence", "a row of upright cylinders, turned by `angle`"};
  static constexpr int kMostPosts = 10000;  // far more than a flow or a picture can show
  Cylinder post;
  Real spacing = 0;
  int posts = 0;

  static ShapeKeys keys(const auto&) {
    return {.needs = {"radius", "height", "spacing", "length"}, .takes = {"angle"}};
  }
  static Fence from(const auto& body) {
    return {{Axis::y, body.radius, body.height}, body.spacing, posts_of(body)};
  }
  static int posts_of(const auto& body) {
    return 1 + static_cast<int>(std::floor(body.length / body.spacing * (1 + 1e-9)));
  }
  static Footprint footprint(const auto& body) {
    const Real c = std::abs(std::cos(body.angle)), s = std::abs(std::sin(body.angle));
    const Real r = body.radius, half = body.length / 2;
    return {
        .half_x = s * half + r, .half_z = c * half + r, .height = body.height, .narrowest = 2 * r};
  }
  static ShapeFault fault(const auto& body) {
    if (body.spacing <= 2 * body.radius)
      return ShapeFault{
          {"spacing", "radius"}, "must be above the diameter of a post, {:.3g} m", 2 * body.radius};
    if (1 + body.length / body.spacing <= kMostPosts) return {};
    return {{"spacing", "length"},
            "must be at least {:.3g} m: a fence has at most 10000 posts",
            body.length / (kMostPosts - 1)};
  }

  KOKKOS_FORCEINLINE_FUNCTION static constexpr Real curvature() { return 0; }
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& p) const {
    const Real last = Real(posts - 1) / 2;
    const Real shift = posts % 2 == 0 ? Real(0.5) : Real(0);
    const Real nearest = Kokkos::round(p.z / spacing - shift) + shift;
    const Real z = p.z - spacing * Kokkos::min(Kokkos::max(nearest, -last), last);
    return post.upright({p.x, p.y, z});
  }
};

}  // namespace barchan::shapes
