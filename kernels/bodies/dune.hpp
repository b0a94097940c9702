// A dune that does not move.
#pragma once

#include "kernels/bodies/shape.hpp"

namespace barchan::shapes {

/// Straight slopes from a crest of `height` down to a foot of two half ellipses, as long as `stoss`
/// upstream (towards smaller x) and `lee` downstream, and 2 `half_width` wide. The dune is convex:
/// its distance is the largest one to the planes that touch it, counted by an angle t, or the
/// distance to the crest.
struct Dune {
  static constexpr Named named{"dune", "straight slopes over two half ellipses"};
  Real height = 0, stoss = 0, lee = 0, half_width = 0;

  static ShapeKeys keys(const auto&) { return {.needs = {"height", "size", "lee"}}; }
  static Dune from(const auto& body) {
    return {body.height, body.size[0] - body.lee, body.lee, body.size[1] / 2};
  }
  static Footprint footprint(const auto& body) {
    const Real half_x = body.size[0] / 2;
    return {.half_x = half_x,
            .half_z = body.size[1] / 2,
            .height = body.height,
            .narrowest = narrower(body.size[0], body.size[1]),
            .middle_x = body.lee - half_x};  // the centre is that of the crest
  }
  static ShapeFault fault(const auto& body) {
    if (body.base > 0)
      return {{"base", "shape"},
              "must be at most 0 with shape = \"dune\", which stands on the floor"};
    if (body.size[0] == 0 || body.size[1] == 0)
      return {{"size"}, "must be above 0 along x and along z"};
    if (body.lee < body.size[0]) return {};
    return ShapeFault{
        {"lee", "size"}, "must be below the length of the dune, {:.3g} m", body.size[0]};
  }
  static ShapeFault misfit(const auto& body, Real lx) {
    if (std::max(body.lee, body.size[0] - body.lee) <= lx / 2) return {};
    return {{"size", "lee", "domain.size"},
            "must not reach farther from the crest than half the length of the domain, "
            "{:.4g} m",
            lx / 2};
  }

  KOKKOS_FORCEINLINE_FUNCTION static constexpr Real curvature() { return 0; }
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& p) const {
    const Real first = p.x < 0 ? stoss : lee;
    Real t = Kokkos::atan2(p.z / half_width, p.x / first);
    ToSurface best;
    for (int n = 0; n < 5; ++n) {
      const Real c = Kokkos::cos(t), s = Kokkos::sin(t);
      const Real k_x = height / (c < 0 ? stoss : lee), k_z = height / half_width;
      const ToSurface at = to_hill(p.y, height - k_x * c * p.x - k_z * s * p.z, -k_x * c, -k_z * s);
      if (n > 0 && !(at.distance > best.distance)) break;
      best = at;
      // Newton's step to where the derivative of N / sqrt(S) is zero.
      const Real slope_n = -k_x * s * p.x + k_z * c * p.z, a = k_x * c * p.x + k_z * s * p.z;
      const Real big_n = a + p.y - height, big_s = 1 + k_x * k_x * c * c + k_z * k_z * s * s;
      const Real half_slope_s = (k_z * k_z - k_x * k_x) * s * c;
      const Real curve =
          -a * big_s + slope_n * half_slope_s - big_n * (k_z * k_z - k_x * k_x) * (c * c - s * s);
      if (!(curve < 0)) break;
      t -= (slope_n * big_s - big_n * half_slope_s) / curve;
    }
    const Vec3 from_crest{p.x, p.y - height, p.z};
    if (from_crest.y <= best.distance * best.normal.y) return best;
    const Real r = norm(from_crest);  // the planes touch above the crest
    return {r, (1 / r) * from_crest};
  }
};

}  // namespace barchan::shapes
