// A hint to the caches.
#pragma once

#include <Kokkos_Core.hpp>
#include <cstddef>

namespace barchan {

/// Asks the caches of a CPU for something that is needed soon.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void prefetch([[maybe_unused]] const T& a) {
  KOKKOS_IF_ON_HOST((const char* begin = reinterpret_cast<const char*>(&a);
                     for (std::size_t line = 0; line < sizeof(T); line += 64)
                         __builtin_prefetch(begin + line);))
}

}  // namespace barchan
