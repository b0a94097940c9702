// Numbers of a few grains or contacts side by side, so that a loop over them fills the vectors of a
// CPU.
#pragma once

#include "kernels/grains/grain.hpp"

namespace barchan {

/// Of a block: enough to fill vectors, small enough for the L1 cache; on a GPU one.
inline constexpr int kBlock = kLargestChunk > 1 ? 32 : 1;

/// How many of a block there are from `begin` on: a constant on a GPU, so that it keeps the block
/// in registers.
KOKKOS_FORCEINLINE_FUNCTION constexpr int size_of_block(int begin, int end) {
  return kBlock == 1 || begin + kBlock <= end ? kBlock : end - begin;
}

/// A Quad of each, as numbers that a loop over the block can read.
struct alignas(64) BlockOfQuads {
  Real row[kBlock][Quad::kSize];

  KOKKOS_FORCEINLINE_FUNCTION Quad operator[](int q) const { return Quad(row[q]); }
  KOKKOS_FORCEINLINE_FUNCTION void put(int q, const Quad& a) { a.store(row[q]); }
  KOKKOS_FORCEINLINE_FUNCTION Vec3 vec(int q) const { return {row[q][0], row[q][1], row[q][2]}; }
  KOKKOS_FORCEINLINE_FUNCTION Real w(int q) const { return row[q][3]; }
};

/// A vector and a spare number of each, component by component: a loop over the block reads and
/// writes them in full vectors, a pass of its own makes Quads of them.
struct alignas(64) BlockOfVectors {
  Real x[kBlock], y[kBlock], z[kBlock], w[kBlock];

  KOKKOS_FORCEINLINE_FUNCTION Vec3 vec(int q) const { return {x[q], y[q], z[q]}; }
  KOKKOS_FORCEINLINE_FUNCTION void put(int q, const Vec3& a, Real a_w) {
    x[q] = a.x, y[q] = a.y, z[q] = a.z, w[q] = a_w;
  }
  KOKKOS_FORCEINLINE_FUNCTION void to_quads(int n, BlockOfQuads& to) const {
#pragma GCC ivdep
    for (int q = 0; q < n; ++q)
      to.row[q][0] = x[q], to.row[q][1] = y[q], to.row[q][2] = z[q], to.row[q][3] = w[q];
  }
};

}  // namespace barchan
