// Real numbers and three-vectors, the only types physics formulas speak.
#pragma once

#include <Kokkos_Core.hpp>

namespace barchan {

using Real = double;

/// Cartesian vector; x along the flow, y up, z across.
struct Vec3 {
  Real x = 0, y = 0, z = 0;

  KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
};

KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 operator*(Real s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
KOKKOS_FORCEINLINE_FUNCTION constexpr Real dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
KOKKOS_FORCEINLINE_FUNCTION Real norm(const Vec3& a) { return Kokkos::sqrt(dot(a, a)); }

}  // namespace barchan
