// Sorting on the device.
#pragma once

#include <Kokkos_Sort.hpp>

#include "src/parallel/mirror.hpp"

namespace barchan {

/// Sorts keys in ascending order, and values with their keys. Values of equal keys come in any
/// order.
template <class Keys, class Values>
void sort_by_key(const Keys& keys, const Values& values) {
  if constexpr (kRehearsal) {  // Kokkos would sort on the host without a kernel
    const auto keys_here = host_copy(keys);
    const auto values_here = host_copy(values);
    Kokkos::Experimental::sort_by_key(Kokkos::DefaultHostExecutionSpace(), keys_here, values_here);
    Kokkos::deep_copy(keys, keys_here);
    Kokkos::deep_copy(values, values_here);
  } else {
    Kokkos::Experimental::sort_by_key(Kokkos::DefaultExecutionSpace(), keys, values);
  }
}

}  // namespace barchan
