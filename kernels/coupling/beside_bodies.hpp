// Smoothing beside bodies: nothing may be carried into them.
// chi is 1 in the fluid and 0 in cells without an open face; K is the smoothing. Then phi = K (f /
// K chi) keeps the sum of f over the fluid, because K is its own adjoint:
//   <chi, K (f / K chi)> = <K chi, f / K chi> = <1, f>.
// Values in closed cells count for nothing; they only serve to undo the smoothing. A force field g
// acts on the smoothed field by the adjoint, K (chi g) / K chi.
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
/// Divides f by K chi.
struct DivideBy {
  ConstFieldRef smoothing_weight;
  FieldRef f;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    f(i, j, k) /= smoothing_weight(i, j, k);
  }
};
/// Fluid fraction before the smoothing, from the fraction without the division by K chi.
struct FractionBesideBodies {
  ConstFieldRef smoothing_weight;
  FieldRef fraction;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    fraction(i, j, k) = 1 - smoothing_weight(i, j, k) * (1 - fraction(i, j, k));
  }
};

}  // namespace barchan
