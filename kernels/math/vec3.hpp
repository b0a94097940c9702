// Real numbers, three-vectors and the periodic box, the only types physics formulas speak.
#pragma once

#include <Kokkos_Core.hpp>

namespace barchan {

using Real = double;

/// Fused a b + c, rounded once where the processor does that in one instruction. It is written out
/// where it counts: left to the compiler, it would depend on where a formula is inlined.
KOKKOS_FORCEINLINE_FUNCTION constexpr Real fma(Real a, Real b, Real c) {
#if defined(__FMA__) || defined(__CUDA_ARCH__)
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}

/// Vector along the floor: x along the flow, z across.
struct Vec2 {
  Real x = 0, z = 0;
};

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
  return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
}
/// Fused s a + b in each component.
KOKKOS_FORCEINLINE_FUNCTION constexpr Vec3 fma(Real s, const Vec3& a, const Vec3& b) {
  return {fma(s, a.x, b.x), fma(s, a.y, b.y), fma(s, a.z, b.z)};
}
KOKKOS_FORCEINLINE_FUNCTION Real norm(const Vec3& a) { return Kokkos::sqrt(dot(a, a)); }

/// Periodic extents [m], the corner at the origin; zero where a direction is not periodic.
struct PeriodicBox {
  Real lx = 0, lz = 0;

  /// Image of a position inside the box, from 0 to lx and 0 to lz.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 wrap(Vec3 x) const {
    if (lx > 0) x.x -= lx * Kokkos::floor(x.x / lx);
    if (lz > 0) x.z -= lz * Kokkos::floor(x.z / lz);
    return x;
  }
  /// Nearest image of a separation between two positions inside the box.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 nearest_image(Vec3 s) const {
    s.x -= s.x > lx / 2 ? lx : Real(0);
    s.x += s.x < -lx / 2 ? lx : Real(0);
    s.z -= s.z > lz / 2 ? lz : Real(0);
    s.z += s.z < -lz / 2 ? lz : Real(0);
    return s;
  }
};

}  // namespace barchan
