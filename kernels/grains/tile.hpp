// Numbers of a few grains or contacts side by side, so that a loop over them fills the vectors of a
// CPU.
#pragma once

#include "kernels/grains/chunks.hpp"
#include "kernels/grains/grain.hpp"

namespace barchan {

/// Number of entries in a block: enough to fill vectors, small enough for the L1 cache; one on a
/// GPU.
inline constexpr int kTile = kOnHost ? 32 : 1;

/// Number of entries of a block that begins at `begin`: a constant on a GPU, so that it keeps the
/// block in registers.
KOKKOS_FORCEINLINE_FUNCTION constexpr int size_of_block(int begin, int end) {
  return kTile == 1 || begin + kTile <= end ? kTile : end - begin;
}

/// Block with a Vec4 per entry, as numbers that a loop can read.
struct alignas(64) AosTile {
  Real lane[kTile][Vec4::kSize];

  KOKKOS_FORCEINLINE_FUNCTION Vec4 operator[](int q) const { return Vec4(lane[q]); }
  KOKKOS_FORCEINLINE_FUNCTION void store(int q, const Vec4& a) { a.store(lane[q]); }
  KOKKOS_FORCEINLINE_FUNCTION Vec3 vec(int q) const { return {lane[q][0], lane[q][1], lane[q][2]}; }
  KOKKOS_FORCEINLINE_FUNCTION Real w(int q) const { return lane[q][3]; }
};

/// Block with a vector and a spare number per entry, component by component: a loop over it reads
/// and writes full vectors. `to_aos` interleaves them in a pass of its own.
struct alignas(64) SoaTile {
  Real x[kTile], y[kTile], z[kTile], w[kTile];

  KOKKOS_FORCEINLINE_FUNCTION Vec3 vec(int q) const { return {x[q], y[q], z[q]}; }
  KOKKOS_FORCEINLINE_FUNCTION void store(int q, const Vec3& a, Real a_w) {
    x[q] = a.x, y[q] = a.y, z[q] = a.z, w[q] = a_w;
  }
  KOKKOS_FORCEINLINE_FUNCTION void to_aos(int n, AosTile& to) const {
#pragma GCC ivdep
    for (int q = 0; q < n; ++q)
      to.lane[q][0] = x[q], to.lane[q][1] = y[q], to.lane[q][2] = z[q], to.lane[q][3] = w[q];
  }
};

}  // namespace barchan
