// Division of [0, n) into consecutive parts.
#pragma once

#include <Kokkos_Core.hpp>

namespace barchan {

/// Partition of [0, n) into consecutive parts, as equal as can be, the longer ones first.
struct BlockPartition {
  int n = 1, parts = 1;

  KOKKOS_FUNCTION int begin(int part) const {
    return part * (n / parts) + (part < n % parts ? part : n % parts);
  }
  KOKKOS_FUNCTION int count(int part) const { return begin(part + 1) - begin(part); }
  /// The part that has element i.
  KOKKOS_FUNCTION int part_of(int i) const {
    const int size = n / parts, longer = n % parts;
    const int in_longer = longer * (size + 1);
    return i < in_longer ? i / (size + 1) : longer + (i - in_longer) / size;
  }
};

}  // namespace barchan
