// A solid body at rest, as flow and grains meet it.
#pragma once

#include "kernels/bodies/body_shapes.hpp"

namespace barchan {

enum class BodyForm {
  cylinder,
  cylinder_x,
  cylinder_z,
  sphere,
  half_sphere,
  box,
  fence,
  dune,
  wave
};

/// One [[body]]. What a form does not need is not looked at.
struct Body {
  BodyForm form = BodyForm::cylinder;
  Vec3 foot;                    // middle of its underside [m]; of a dune below the crest
  Real cosine = 1, sine = 0;    // of the angle by which it is turned from x towards z
  Real lx = 0, lz = 0;          // periods of the domain [m]
  Real radius = 0, height = 0;  // [m]
  Vec2 half_size;               // along x, along z [m]; 0: no ends there
  Real stoss = 0, lee = 0;      // of a dune [m]
  Real spacing = 0;             // of posts, or the wavelength [m]
  int posts = 0;

  /// Distance from x, which may be outside the domain, and normal of the nearest image.
  KOKKOS_INLINE_FUNCTION ToSurface to_surface(const Vec3& x) const {
    const Vec3 s = from_foot(x);
    const Vec3 p{cosine * s.x + sine * s.z, s.y, cosine * s.z - sine * s.x};
    const ToSurface at = of_form(p);
    const Vec3& n = at.normal;
    return {at.distance, {cosine * n.x - sine * n.z, n.y, cosine * n.z + sine * n.x}};
  }
  /// x as seen from the foot of that image [m].
  KOKKOS_FORCEINLINE_FUNCTION Vec3 from_foot(const Vec3& x) const {
    Vec3 s = x - foot;
    s.x -= lx * Kokkos::round(s.x / lx);
    s.z -= lz * Kokkos::round(s.z / lz);
    return s;
  }
  KOKKOS_FORCEINLINE_FUNCTION Real distance(const Vec3& x) const { return to_surface(x).distance; }

  /// Radius of curvature where a grain touches it [m]; 0: as a flat wall. Grains are far smaller
  /// than a cylinder, so the line of contact that it lacks does not count.
  KOKKOS_FORCEINLINE_FUNCTION Real curvature() const {
    return form == BodyForm::sphere || form == BodyForm::half_sphere ? radius : Real(0);
  }

 private:
  KOKKOS_INLINE_FUNCTION ToSurface of_form(const Vec3& p) const {
    switch (form) {
      case BodyForm::cylinder:
        return to_cylinder(p, radius, height);
      case BodyForm::cylinder_x:
        return to_lying_cylinder(p, radius, half_size.x);
      case BodyForm::cylinder_z: {
        const ToSurface at = to_lying_cylinder({p.z, p.y, p.x}, radius, half_size.z);
        return {at.distance, {at.normal.z, at.normal.y, at.normal.x}};
      }
      case BodyForm::sphere:
        return to_sphere(p, radius);
      case BodyForm::half_sphere:
        return to_half_sphere(p, radius);
      case BodyForm::box:
        return to_box(p, half_size, height);
      case BodyForm::fence:
        return to_fence(p, radius, height, spacing, posts);
      case BodyForm::dune:
        return to_dune(p, height, stoss, lee, half_size.z);
      case BodyForm::wave:
        return to_wave(p, height, spacing);
    }
    return {};
  }
};

/// All bodies of a case.
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
