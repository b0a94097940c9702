// Values in memory that is lent from one task to the next.
#pragma once

#include <concepts>
#include <cstdint>

#include "kernels/fluid/grid.hpp"

namespace barchan {

/// True if memory that is lent anew first gets values that no result survives: a kernel that reads
/// beyond the cells in which another wrote is then seen at once. Always on in builds with
/// sanitizers; tests switch it on elsewhere.
#ifdef BARCHAN_POISON
inline bool poisons_lent_memory = true;
#else
inline bool poisons_lent_memory = false;
#endif

template <class View>
void poison_with(const typename View::value_type& value, const View& memory) {
  if (poisons_lent_memory && memory.size() > 0)
    Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), memory, value);
}

/// Poisons fields that are written before they are read.
template <std::same_as<Field>... Fields>
void poison(const Fields&... fields) {
  (poison_with(Kokkos::Experimental::quiet_NaN_v<Real>, fields.storage), ...);
}
inline void poison(const FaceVector& f) { poison(f.x, f.y, f.z); }

/// Poisons fields that are multiplied with zero where nobody wrote.
template <std::same_as<Field>... Fields>
void poison_finite(const Fields&... fields) {
  (poison_with(Real(1e30), fields.storage), ...);
}

/// Poisons sums in fixed point.
inline void poison(const Kokkos::View<std::int64_t**, Kokkos::LayoutLeft>& sums) {
  poison_with(std::int64_t{1} << 62, sums);
}

}  // namespace barchan
