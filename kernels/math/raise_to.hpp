// A maximum of what many threads find.
#pragma once

#include <Kokkos_Core.hpp>

namespace barchan {

/// *at becomes the larger of *at and value. It is read first, for few values are larger than all
/// before them.
KOKKOS_FORCEINLINE_FUNCTION void raise_to(int* at, int value) {
  if (Kokkos::atomic_load(at) < value) Kokkos::atomic_max(at, value);
}

}  // namespace barchan
