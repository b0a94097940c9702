// The smoothing beside bodies, into which it must not carry anything.
//
// With chi = 1 in the water, 0 in cells without an open face, and K the smoothing: phi = K (f / K
// chi) keeps the sum of f over the water, because K is its own adjoint:
//   <chi, K (f / K chi)> = <K chi, f / K chi> = <1, f>.
// What stands in closed cells counts for nothing, and serves to undo the smoothing. The force of a
// field g on what is smoothed so goes the adjoint way, K (chi g) / K chi.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

struct KeepAbove {
  FieldRef f;
  Real least;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    f(i, j, k) = Kokkos::max(f(i, j, k), least);
  }
};
/// f / K chi.
struct DivideBy {
  ConstFieldRef kept;
  FieldRef f;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    f(i, j, k) /= kept(i, j, k);
  }
};
/// The fluid fraction before the smoothing, of that without the division.
struct FractionBesideBodies {
  ConstFieldRef kept;
  FieldRef fraction;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    fraction(i, j, k) = 1 - kept(i, j, k) * (1 - fraction(i, j, k));
  }
};

}  // namespace barchan
