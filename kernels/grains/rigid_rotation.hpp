// Rotation of a rigid body that is no sphere: orientation, angular momentum in space, and the free
// motion of both.
#pragma once

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Unit quaternion: the orientation of a body. It turns vectors from the frame of the body into
/// space.
struct Quaternion {
  Real w = 1, x = 0, y = 0, z = 0;

  KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 vec() const { return {x, y, z}; }
};

KOKKOS_FORCEINLINE_FUNCTION constexpr Quaternion quaternion(Real w, const Vec3& v) {
  return {w, v.x, v.y, v.z};
}
/// First b, then a, as of matrices.
KOKKOS_FORCEINLINE_FUNCTION constexpr Quaternion operator*(const Quaternion& a,
                                                           const Quaternion& b) {
  const Vec3 u = a.vec(), v = b.vec();
  return quaternion(fma(a.w, b.w, -dot(u, v)), fma(a.w, v, fma(b.w, u, cross(u, v))));
}
/// The opposite rotation.
KOKKOS_FORCEINLINE_FUNCTION constexpr Quaternion conjugate(const Quaternion& q) {
  return {q.w, -q.x, -q.y, -q.z};
}
/// Vector of the body in space.
KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 rotate(const Quaternion& q, const Vec3& a) {
  const Vec3 t = 2 * cross(q.vec(), a);
  return fma(q.w, t, a + cross(q.vec(), t));
}
/// Vector of space in the frame of the body.
KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 rotate_back(const Quaternion& q, const Vec3& a) {
  return rotate(conjugate(q), a);
}
/// Length back to 1 from a length that round-off has changed: Newton's step for 1/sqrt at 1.
KOKKOS_FORCEINLINE_FUNCTION constexpr Quaternion of_unit_length(const Quaternion& q) {
  const Real s = Real(1.5) - Real(0.5) * fma(q.w, q.w, dot(q.vec(), q.vec()));
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}
/// Rotation by an angle [rad] about a unit vector.
KOKKOS_FORCEINLINE_FUNCTION Quaternion rotation_about(const Vec3& axis, Real angle) {
  return quaternion(Kokkos::cos(angle / 2), Kokkos::sin(angle / 2) * axis);
}

/// Angular velocity omega = R I^-1 R^T J in space [rad/s]; inertia: principal moments [kg m^2],
/// j: angular momentum J in space [kg m^2/s].
KOKKOS_FORCEINLINE_FUNCTION Vec3 angular_velocity(const Quaternion& q, const Vec3& inertia,
                                                  const Vec3& j) {
  const Vec3 l = rotate_back(q, j);
  return rotate(q, {l.x / inertia.x, l.y / inertia.y, l.z / inertia.z});
}
/// Angular momentum J = R I R^T omega in space [kg m^2/s].
KOKKOS_FORCEINLINE_FUNCTION Vec3 angular_momentum(const Quaternion& q, const Vec3& inertia,
                                                  const Vec3& omega) {
  const Vec3 w = rotate_back(q, omega);
  return rotate(q, {inertia.x * w.x, inertia.y * w.y, inertia.z * w.z});
}

/// Body in free rotation: its orientation, and its angular momentum in its own frame.
struct FreeBody {
  Quaternion q;
  Vec3 l;

  /// Turns by an angle about an axis of its own. The angular momentum stays in space, so in the
  /// frame of the body it turns the other way.
  KOKKOS_FORCEINLINE_FUNCTION void turn_x(Real angle) {
    const Real c = Kokkos::cos(angle / 2), s = Kokkos::sin(angle / 2);
    q = {fma(c, q.w, -(s * q.x)), fma(c, q.x, s * q.w), fma(c, q.y, s * q.z),
         fma(c, q.z, -(s * q.y))};
    const Real cos = fma(c, c, -(s * s)), sin = 2 * s * c;
    l = {l.x, fma(cos, l.y, sin * l.z), fma(cos, l.z, -(sin * l.y))};
  }
  KOKKOS_FORCEINLINE_FUNCTION void turn_y(Real angle) {
    const Real c = Kokkos::cos(angle / 2), s = Kokkos::sin(angle / 2);
    q = {fma(c, q.w, -(s * q.y)), fma(c, q.x, -(s * q.z)), fma(c, q.y, s * q.w),
         fma(c, q.z, s * q.x)};
    const Real cos = fma(c, c, -(s * s)), sin = 2 * s * c;
    l = {fma(cos, l.x, -(sin * l.z)), l.y, fma(cos, l.z, sin * l.x)};
  }
};

/// Orientation after a time h [s] without torque. The energy is split into L^2/(2 I_z), which turns
/// the body about J in space and commutes with the rest, and (1/I_x - 1/I_z) L_x^2/2 and
/// (1/I_y - 1/I_z) L_y^2/2, which turn it about its own axes: x/2, y, x/2. Symplectic, reversible,
/// of second order; J in space is constant. Exact for a sphere and where I_z equals another moment;
/// the error falls with the differences of the moments. Dullweber, Leimkuhler & McLachlan, J. Chem.
/// Phys. 107, 5840 (1997) split into axes; Touma & Wisdom, Astron. J. 107, 1189 (1994) into
/// symmetric tops.
KOKKOS_FORCEINLINE_FUNCTION Quaternion rotate_freely(const Quaternion& q, const Vec3& inertia,
                                                     const Vec3& j, Real h) {
  FreeBody body{q, rotate_back(q, j)};
  const Real of_x = 1 / inertia.x - 1 / inertia.z, of_y = 1 / inertia.y - 1 / inertia.z;
  body.turn_x(h / 2 * body.l.x * of_x);
  body.turn_y(h * body.l.y * of_y);
  body.turn_x(h / 2 * body.l.x * of_x);
  const Real size = norm(j);
  if (size == 0) return of_unit_length(body.q);
  const Quaternion about_j = rotation_about((1 / size) * j, h * size / inertia.z);
  return of_unit_length(about_j * body.q);
}

}  // namespace barchan
