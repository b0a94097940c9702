// Three components and a spare number, loaded, computed and stored together.
#pragma once

#include "kernels/math/vec3.hpp"

#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__)
#define BARCHAN_VECTOR_REGISTERS
#endif

namespace barchan {

/// Four numbers: one vector register on a CPU. A compiler by itself leaves the unused fourth out
/// and computes three one by one. Each component gets the bits that it gets on its own.
struct Vec4 {
  static constexpr int kSize = 4;
#ifdef BARCHAN_VECTOR_REGISTERS
  Real v __attribute__((vector_size(kSize * sizeof(Real))));
#else
  alignas(kSize * sizeof(Real)) Real v[kSize];
#endif

  Vec4() = default;
  KOKKOS_FORCEINLINE_FUNCTION Vec4(Real x, Real y, Real z, Real w) : v{x, y, z, w} {}
  KOKKOS_FORCEINLINE_FUNCTION explicit Vec4(const Real* a) : Vec4(a[0], a[1], a[2], a[3]) {}

  KOKKOS_FORCEINLINE_FUNCTION Vec3 vec() const { return {v[0], v[1], v[2]}; }
  KOKKOS_FORCEINLINE_FUNCTION Real w() const { return v[3]; }
  KOKKOS_FORCEINLINE_FUNCTION void store(Real* to) const {
    for (int q = 0; q < kSize; ++q) to[q] = v[q];
  }
};

KOKKOS_FORCEINLINE_FUNCTION Vec4 vec4(const Vec3& a) { return {a.x, a.y, a.z, 0}; }

#ifdef BARCHAN_VECTOR_REGISTERS
KOKKOS_FORCEINLINE_FUNCTION Vec4 operator+(const Vec4& a, const Vec4& b) {
  Vec4 sum;
  sum.v = a.v + b.v;
  return sum;
}
KOKKOS_FORCEINLINE_FUNCTION Vec4 operator-(const Vec4& a, const Vec4& b) {
  Vec4 difference;
  difference.v = a.v - b.v;
  return difference;
}
KOKKOS_FORCEINLINE_FUNCTION Vec4 fma(Real s, const Vec4& a, const Vec4& b) {
  Vec4 sum;
#if defined(__FMA__) && !defined(__clang__)  // g++ does not find these by itself
  const Vec4 factor(s, s, s, s);
  sum.v = __builtin_ia32_vfmaddpd256(factor.v, a.v, b.v);
#else
  for (int q = 0; q < Vec4::kSize; ++q) sum.v[q] = fma(s, a.v[q], b.v[q]);
#endif
  return sum;
}
#else
KOKKOS_FORCEINLINE_FUNCTION Vec4 operator+(const Vec4& a, const Vec4& b) {
  return {a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2], a.v[3] + b.v[3]};
}
KOKKOS_FORCEINLINE_FUNCTION Vec4 operator-(const Vec4& a, const Vec4& b) {
  return {a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2], a.v[3] - b.v[3]};
}
KOKKOS_FORCEINLINE_FUNCTION Vec4 fma(Real s, const Vec4& a, const Vec4& b) {
  return {fma(s, a.v[0], b.v[0]), fma(s, a.v[1], b.v[1]), fma(s, a.v[2], b.v[2]),
          fma(s, a.v[3], b.v[3])};
}
#endif
#undef BARCHAN_VECTOR_REGISTERS

}  // namespace barchan
