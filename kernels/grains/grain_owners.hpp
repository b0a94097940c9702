// Which rank owns which columns of grains, and who needs copies of a grain.
#pragma once

#include <cstdint>

#include "kernels/grains/neighbor_search.hpp"

namespace barchan {

/// Rank r owns the columns from place start(r) on the Morton curve up to start(r + 1); start(0) is
/// 0. A rank that starts where the next one does owns nothing.
struct GrainOwners {
  int me = 0;
  Kokkos::View<const std::uint32_t*> start;  // (ranks)

  KOKKOS_FUNCTION int of_place(std::uint32_t place) const {
    int low = 0, high = static_cast<int>(start.extent(0));
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      if (start(middle) <= place) {
        low = middle;
      } else {
        high = middle;
      }
    }
    return low;
  }
};

/// The other ranks that own a column next to a grain's: they need a copy of it.
struct GhostDestinations {
  static constexpr int kMost = 8;
  int n = 0;
  int rank[kMost];

  KOKKOS_FUNCTION GhostDestinations(const SearchColumns& columns, const GrainOwners& owners,
                                    const Vec3& x) {
    const std::uint32_t column = columns.column_of(x);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dz = -1; dz <= 1; ++dz) {
        std::uint32_t other = 0;
        if (!columns.neighbor(column, dx, dz, other)) continue;
        add(owners.of_place(other + columns.origin), owners.me);
      }
    }
  }

 private:
  KOKKOS_FUNCTION void add(int owner, int me) {
    if (owner == me) return;
    for (int q = 0; q < n; ++q) {
      if (rank[q] == owner) return;
    }
    rank[n++] = owner;
  }
};

}  // namespace barchan
