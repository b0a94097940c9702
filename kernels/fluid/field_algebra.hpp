// Algebra of cell fields.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "kernels/math/device_scalar.hpp"

namespace barchan {

struct SetZero {
  FieldRef f;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const { f(i, j, k) = 0; }
};

/// y = a x + b y.
struct Axpby {
  Real a;
  ConstFieldRef x;
  Real b;
  FieldRef y;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    y(i, j, k) = a * x(i, j, k) + b * y(i, j, k);
  }
};

/// f -= constant.
struct Subtract {
  FieldRef f;
  DeviceScalar constant;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const { f(i, j, k) -= constant; }
};

}  // namespace barchan
