// Three-by-three tensors, as far as velocity gradients need them.
#pragma once

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Tensor by rows; for a velocity gradient xy is du/dy.
struct Mat3 {
  Real xx = 0, xy = 0, xz = 0;
  Real yx = 0, yy = 0, yz = 0;
  Real zx = 0, zy = 0, zz = 0;
};

KOKKOS_FORCEINLINE_FUNCTION constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
  return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}
KOKKOS_FORCEINLINE_FUNCTION constexpr Real trace(const Mat3& a) { return a.xx + a.yy + a.zz; }

/// s : s of the symmetric part s of a.
KOKKOS_FORCEINLINE_FUNCTION constexpr Real symmetric_part_squared(const Mat3& a) {
  const Real xy = Real(0.5) * (a.xy + a.yx);
  const Real xz = Real(0.5) * (a.xz + a.zx);
  const Real yz = Real(0.5) * (a.yz + a.zy);
  return a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + 2 * (xy * xy + xz * xz + yz * yz);
}

}  // namespace barchan
