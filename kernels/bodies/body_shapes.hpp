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
/// `stoss` upstream (towards smaller x) and `lee` downstream, as wide as 2 `half_width`. Convex, so
/// the distance is the largest one to the planes that touch it, which an angle t counts, or that to
/// the crest.
KOKKOS_INLINE_FUNCTION ToSurface to_dune(const Vec3& p, Real height, Real stoss, Real lee,
                                         Real half_width) {
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

/// A wavy floor, crests `height` above troughs, one crest at x = 0. Exact as far from it as half
/// its smallest radius of curvature, farther to first order in the curvature.
KOKKOS_INLINE_FUNCTION ToSurface to_wave(const Vec3& p, Real height, Real wavelength) {
  const Real k = 2 * Real(3.141592653589793238) / wavelength, half = height / 2;
  const ToSurface near =
      to_hill(p.y, half * (1 + Kokkos::cos(k * p.x)), -half * k * Kokkos::sin(k * p.x), 0);
  if (Kokkos::abs(near.distance) * half * k * k > Real(0.5)) return near;
  Real x = p.x - near.distance * near.normal.x;  // of the nearest point, by Newton's steps
  for (int n = 0; n < 4; ++n) {
    const Real f = half * (1 + Kokkos::cos(k * x)), slope = -half * k * Kokkos::sin(k * x);
    const Real curve = k * k * (half - f);
    x -= (x - p.x + (f - p.y) * slope) / (1 + slope * slope + (f - p.y) * curve);
  }
  const Real slope = -half * k * Kokkos::sin(k * x);
  const Vec3 n = to_hill(0, 0, slope, 0).normal;
  return {n.x * (p.x - x) + n.y * (p.y - half * (1 + Kokkos::cos(k * x))), n};
}

}  // namespace barchan
