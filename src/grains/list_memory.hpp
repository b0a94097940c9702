// Memory of a neighbour list, reused from rebuild to rebuild.
#pragma once

#include <algorithm>
#include <string>

#include "src/base/scratch_memory.hpp"
#include "src/parallel/scan.hpp"

namespace barchan {

/// Size of an array for n entries: a sixteenth more, and at least a few.
inline int with_slack(int n) { return n + n / 16 + 64; }

template <class View>
View uninitialized(const char* label, int n) {
  return View(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing),
              static_cast<std::size_t>(n));
}

/// Makes room for n entries, kept between rebuilds; grows by more than asked.
template <class View>
void reserve(View& view, const char* label, int n) {
  if (view.extent_int(0) < std::max(n, 1)) view = uninitialized<View>(label, with_slack(n));
}

/// Reuses the memory of a view that is no longer needed for n entries of another one. It must be
/// large enough.
template <class View, class Before>
View used_as(const Before& memory, int n) {
  return View(reinterpret_cast<typename View::value_type*>(memory.data()),
              static_cast<std::size_t>(n));
}

/// Takes scratch memory if there is enough, else reserves memory.
template <class T>
void take_scratch(ScratchMemory& scratch, Kokkos::View<T*>& view, const char* label, int n) {
  const auto taken = scratch.take<T>(static_cast<std::size_t>(with_slack(n)));
  if (taken.extent(0) > 0) {
    view = taken;
    return;
  }
  if (view.use_count() == 0) view = {};  // scratch memory of an earlier rebuild
  reserve(view, label, n);
}

/// Turns counts in [0, n) into offsets from `begin` on, the end at n. Returns the end.
inline int counts_to_offsets(const Kokkos::View<int*>& a, int n, int begin = 0) {
  const int total = scan(
      "neighbors: prefix sum", Kokkos::RangePolicy<>(0, n),
      KOKKOS_LAMBDA(int i, int& sum, bool final) {
        const int count = a(i);
        if (final) a(i) = begin + sum;
        sum += count;
      });
  Kokkos::deep_copy(Kokkos::subview(a, n), begin + total);
  return begin + total;
}

}  // namespace barchan
