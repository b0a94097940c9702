// The history of contacts while the list that holds it is replaced.
#pragma once

#include <cstdint>

#include "kernels/grains/grain.hpp"

namespace barchan {

/// Contacts under grains (rows before the replacement) with the id of the partner: ids survive
/// sorting and migration.
struct ContactHistory {
  Kokkos::View<int*> first;             // (rows + 1)
  Kokkos::View<std::int64_t*> partner;  // (contacts) id
  Kokkos::View<Vec3*> xi_t;             // (contacts) of the grain relative to the partner [m]
  Kokkos::View<Vec3*> rolling, force;   // on the grain [N m], [N]; empty where the list has none

  KOKKOS_FORCEINLINE_FUNCTION bool has_rolling() const { return rolling.extent(0) > 0; }
  KOKKOS_FORCEINLINE_FUNCTION bool has_force() const { return force.extent(0) > 0; }

  /// Index of the contact of a row with a grain, or -1.
  KOKKOS_FUNCTION int find(int row, std::int64_t id) const {
    for (int k = first(row); k < first(row + 1); ++k) {
      if (partner(k) == id) return k;
    }
    return -1;
  }
};

/// Calls f(row, id of the partner, sign) for the grains that keep the history of the contact in a
/// slot: its first grain, or with `both` each one that is owned. History is that of the first
/// grain; seen from the second one it has the sign -1.
struct GrainsWithHistory {
  PairList list;
  Kokkos::View<const std::int64_t*> id;
  bool both = false;

  template <class Action>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int slot, const Action& action) const {
    const int i = list.i(slot), j = list.j(slot);
    if (i < list.chunks.n) action(i, id(j), Real(1));
    if (both && j < list.chunks.n) action(j, id(i), Real(-1));
  }
};

/// Number of contacts under each grain; `count` starts at zero.
struct CountContacts {
  GrainsWithHistory grains;
  Kokkos::View<int*> count;
  KOKKOS_FUNCTION void operator()(int slot) const {
    if (!grains.list.touching(slot)) return;
    grains(slot, [&](int g, std::int64_t, Real) { Kokkos::atomic_inc(&count(g)); });
  }
};

/// Copies their history, that of one grain in whatever order the threads come; `cursor` starts as
/// history.first.
struct FillContactHistory {
  GrainsWithHistory grains;
  ContactHistory history;
  Kokkos::View<int*> cursor;
  KOKKOS_FUNCTION void operator()(int slot) const {
    const PairList& list = grains.list;
    if (!list.touching(slot)) return;
    grains(slot, [&](int g, std::int64_t partner, Real sign) {
      const int k = Kokkos::atomic_fetch_add(&cursor(g), 1);
      history.partner(k) = partner;
      history.xi_t(k) = sign * list.xi_t(slot);
      if (list.has_rolling()) history.rolling(k) = sign * list.rolling(slot);
      if (list.has_force()) history.force(k) = sign * list.force(slot);
    });
  }
};

}  // namespace barchan
