// Distances to solids about their own origin, the middle of their underside; y is upwards.
#pragma once

#include "kernels/math/vec3.hpp"

namespace barchan {

/// What a place knows of a surface.
struct ToSurface {
  Real distance = 0;  // [m], positive outside
  Vec3 normal;        // unit vector outwards: the gradient of the distance
};

/// Distance to a convex body near a corner where faces meet at right angles: d [m] is that to each
/// face, n its normal.
template <int faces>
KOKKOS_INLINE_FUNCTION ToSurface to_corner(const Real (&d)[faces], const Vec3 (&n)[faces]) {
  int nearest = 0, outside = 0;
  Vec3 out;
  for (int f = 0; f < faces; ++f) {
    if (d[f] > d[nearest]) nearest = f;
    if (d[f] <= 0) continue;
    ++outside;
    out += d[f] * n[f];
  }
  if (outside < 2) return {d[nearest], n[nearest]};
  const Real distance = norm(out);
  return {distance, (1 / distance) * out};
}

KOKKOS_FORCEINLINE_FUNCTION Real sign_of(Real a) { return a < 0 ? Real(-1) : Real(1); }

/// Unit vector along (x, 0, z), which has length r; along x if that is zero.
KOKKOS_FORCEINLINE_FUNCTION Vec3 away_from_axis(Real x, Real z, Real r) {
  return r > 0 ? Vec3{x / r, 0, z / r} : Vec3{1, 0, 0};
}

/// Upright cylinder.
KOKKOS_INLINE_FUNCTION ToSurface to_cylinder(const Vec3& p, Real radius, Real height) {
  const Real r = Kokkos::sqrt(p.x * p.x + p.z * p.z), up = p.y - height / 2;
  return to_corner<2>({r - radius, Kokkos::abs(up) - height / 2},
                      {away_from_axis(p.x, p.z, r), {0, sign_of(up), 0}});
}

/// Cylinder along x, lowest line at y = 0; of half length 0 it has no ends.
KOKKOS_INLINE_FUNCTION ToSurface to_lying_cylinder(const Vec3& p, Real radius, Real half_length) {
  const Real y = p.y - radius, r = Kokkos::sqrt(y * y + p.z * p.z);
  const Vec3 out = r > 0 ? Vec3{0, y / r, p.z / r} : Vec3{0, 1, 0};
  if (half_length == 0) return {r - radius, out};
  return to_corner<2>({r - radius, Kokkos::abs(p.x) - half_length}, {out, {sign_of(p.x), 0, 0}});
}

KOKKOS_INLINE_FUNCTION ToSurface to_sphere(const Vec3& p, Real radius) {
  const Vec3 s{p.x, p.y - radius, p.z};
  const Real r = norm(s);
  return {r - radius, r > 0 ? (1 / r) * s : Vec3{0, 1, 0}};
}

/// Upper half of a sphere about the origin.
KOKKOS_INLINE_FUNCTION ToSurface to_half_sphere(const Vec3& p, Real radius) {
  if (p.y < 0) {
    const Real r = Kokkos::sqrt(p.x * p.x + p.z * p.z);
    return to_corner<2>({r - radius, -p.y}, {away_from_axis(p.x, p.z, r), {0, -1, 0}});
  }
  const Real r = norm(p);
  if (-p.y > r - radius) return {-p.y, {0, -1, 0}};
  return {r - radius, r > 0 ? (1 / r) * p : Vec3{0, 1, 0}};
}

/// Box of half sizes h.x and h.z; of half size 0 it has no sides there.
KOKKOS_INLINE_FUNCTION ToSurface to_box(const Vec3& p, const Vec2& h, Real height) {
  const Real up = p.y - height / 2;
  const Real dx = h.x > 0 ? Kokkos::abs(p.x) - h.x : -height;
  const Real dz = h.z > 0 ? Kokkos::abs(p.z) - h.z : -height;
  return to_corner<3>({Kokkos::abs(up) - height / 2, dx, dz},
                      {{0, sign_of(up), 0}, {sign_of(p.x), 0, 0}, {0, 0, sign_of(p.z)}});
}

/// Upright cylinders in a row along z, `count` of them, `spacing` apart, the row centred.
KOKKOS_INLINE_FUNCTION ToSurface to_fence(const Vec3& p, Real radius, Real height, Real spacing,
                                          int count) {
  const Real last = Real(count - 1) / 2;
  const Real shift = count % 2 == 0 ? Real(0.5) : Real(0);
  const Real post = Kokkos::round(p.z / spacing - shift) + shift;
  const Real z = p.z - spacing * Kokkos::min(Kokkos::max(post, -last), last);
  return to_cylinder({p.x, p.y, z}, radius, height);
}

/// Surface y = f(x, z) of slopes f_x and f_z: exact on a plane, to first order in the curvature
/// elsewhere.
KOKKOS_FORCEINLINE_FUNCTION ToSurface to_hill(Real y, Real f, Real f_x, Real f_z) {
  const Real scale = 1 / Kokkos::sqrt(1 + f_x * f_x + f_z * f_z);
  return {scale * (y - f), {-scale * f_x, scale, -scale * f_z}};
}

/// A dune: straight slopes from a crest of `height` down to a foot of two half ellipses, as long as
/// `stoss` upstream (towards smaller x) and `lee` downstream, as wide as 2 `half_width`.
KOKKOS_INLINE_FUNCTION ToSurface to_dune(const Vec3& p, Real height, Real stoss, Real lee,
                                         Real half_width) {
  const Real a = p.x < 0 ? stoss : lee, b = half_width;
  const Real x = p.x / a, z = p.z / b, rho = Kokkos::sqrt(x * x + z * z);
  const Real slope = rho > 0 ? -height / rho : Real(0);
  return to_hill(p.y, height * (1 - rho), slope * x / a, slope * z / b);
}

/// A wavy floor, crests `height` above troughs, one crest at x = 0.
KOKKOS_INLINE_FUNCTION ToSurface to_wave(const Vec3& p, Real height, Real wavelength) {
  const Real k = 2 * Real(3.141592653589793238) / wavelength;
  return to_hill(p.y, height / 2 * (1 + Kokkos::cos(k * p.x)),
                 -height / 2 * k * Kokkos::sin(k * p.x), 0);
}

}  // namespace barchan
