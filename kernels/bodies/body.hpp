// A solid body at rest, as flow and grains meet it.
#pragma once

#include "kernels/bodies/box.hpp"
#include "kernels/bodies/cylinder.hpp"
#include "kernels/bodies/dune.hpp"
#include "kernels/bodies/fence.hpp"
#include "kernels/bodies/half_sphere.hpp"
#include "kernels/bodies/sphere.hpp"
#include "kernels/bodies/wave.hpp"
#include "kernels/math/one_of.hpp"

namespace barchan {

using BodyShapes = Alternatives<shapes::Cylinder, shapes::Sphere, shapes::HalfSphere, shapes::Box,
                                shapes::Fence, shapes::Dune, shapes::Wave>;

/// A body of a case: one [[body]].
struct Body {
  OneOf<BodyShapes> shape;
  Vec3 foot;                  // middle of its underside [m]; a dune's foot lies below its crest
  Real cosine = 1, sine = 0;  // cosine and sine of the turning angle from x towards z
  Real lx = 0, lz = 0;        // periods of the domain [m]

  /// Distance from x, which may be outside the domain, and normal of the nearest image.
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& x) const {
    const Vec3 s = from_foot(x);
    const Vec3 p{cosine * s.x + sine * s.z, s.y, cosine * s.z - sine * s.x};
    const ToSurface at = shape.visit([&](const auto& it) { return it.to_surface(p); });
    const Vec3& n = at.normal;
    return {at.distance, {cosine * n.x - sine * n.z, n.y, cosine * n.z + sine * n.x}};
  }
  /// Position x seen from the foot of the nearest image of the body [m].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 from_foot(const Vec3& x) const {
    Vec3 s = x - foot;
    s.x -= lx * Kokkos::round(s.x / lx);
    s.z -= lz * Kokkos::round(s.z / lz);
    return s;
  }
  KOKKOS_FORCEINLINE_FUNCTION Real distance(const Vec3& x) const { return to_surface(x).distance; }

  /// Radius of curvature where a grain touches the body [m]; 0: as a flat wall. A cylinder counts
  /// as a sphere: grains are far smaller, so the line of contact does not matter.
  KOKKOS_FORCEINLINE_FUNCTION Real curvature() const {
    return shape.visit([](const auto& it) { return it.curvature(); });
  }
};

/// Largest number of bodies in a case.
inline constexpr int kMostBodies = 8;
struct Bodies {
  int n = 0;
  Body body[kMostBodies];

  struct Nearest {
    int body = -1;  // -1: there is none
    ToSurface surface;
  };
  /// The body whose surface is nearest to x, or that x is deepest in.
  KOKKOS_INLINE_FUNCTION Nearest nearest(const Vec3& x) const {
    Nearest found;
    for (int b = 0; b < n; ++b) {
      const ToSurface at = body[b].to_surface(x);
      if (found.body < 0 || at.distance < found.surface.distance) found = {b, at};
    }
    return found;
  }
};

}  // namespace barchan
