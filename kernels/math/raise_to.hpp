// Maximum over threads.
#pragma once

#include <Kokkos_Core.hpp>

namespace barchan {

/// Raises *at to value if that is larger. *at is read first, because few values are larger than all
/// before them.
KOKKOS_FORCEINLINE_FUNCTION void raise_to(int* at, int value) {
  if (Kokkos::atomic_load(at) < value) Kokkos::atomic_max(at, value);
}

}  // namespace barchan
