// Neighbour search: pairs of grains in the same or neighbouring columns, and the contact history
// that they take over.
#pragma once

#include <cstdint>

#include "kernels/grains/clump.hpp"
#include "kernels/grains/law_table.hpp"
#include "kernels/grains/pair_list.hpp"
#include "kernels/grains/search_columns.hpp"

namespace barchan {

/// Contact history: contacts under grains (entries before the replacement) with the id of the
/// partner. Ids survive sorting and migration.
struct ContactHistory {
  Kokkos::View<int*> first;             // (entries + 1)
  Kokkos::View<std::int64_t*> partner;  // (contacts) id
  Kokkos::View<Vec3*> xi_t;             // (contacts) of the grain relative to the partner [m]
  Kokkos::View<Vec3*> rolling, force;   // on the grain [N m], [N]; empty where the list has none

  KOKKOS_FORCEINLINE_FUNCTION bool has_rolling() const { return rolling.extent(0) > 0; }
  KOKKOS_FORCEINLINE_FUNCTION bool has_force() const { return force.extent(0) > 0; }

  /// Index of the contact of an entry with a grain, or -1.
  KOKKOS_FUNCTION int find(int entry, std::int64_t id) const {
    for (int k = first(entry); k < first(entry + 1); ++k) {
      if (partner(k) == id) return k;
    }
    return -1;
  }
};

/// Calls f(entry, id of the partner, sign) for the grains that keep the history of the contact in a
/// slot: its first grain, or with `both` each one that is owned. The history is that of the first
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

/// Copies the contact history; contacts of one grain come in the order of the threads. `cursor`
/// starts as history.first.
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

/// First entry that grain i looks at in each forward column; grains before it are too low.
using Windows = Kokkos::View<int* [kForwardColumns], Kokkos::MemoryUnmanaged>;

/// Fills the windows of the grains of a column, all forward columns in one walk upwards: O(grains).
struct FindWindows {
  Kokkos::View<const GrainKinematics*> grains;
  OccupiedColumns occupied;
  Windows window;

  KOKKOS_FUNCTION void operator()(int c) const {
    for (int m = 0; m < kForwardColumns; ++m) {
      const int other = occupied.forward(c, m);
      if (other < 0) continue;
      const Real reach = occupied.widest(c) + occupied.widest(other);
      int j = occupied.start(other);
      const int end = occupied.start(other + 1);
      for (int i = occupied.start(c); i < occupied.start(c + 1); ++i) {
        const Real lowest = grains(i).x.y - reach;
        while (j < end && grains(j).x.y < lowest) ++j;
        window(i, m) = j;
      }
    }
  }
};

/// Offset of the m-th column of the outer ring.
struct OuterColumn {
  int dx = 0, dz = 0;
  KOKKOS_FORCEINLINE_FUNCTION explicit OuterColumn(int m)
      : dx(m < 10 ? 2 * (m % 2) * 2 - 2 : (m - 10) / 2 - 1),
        dz(m < 10 ? m / 2 - 2 : 4 * (m % 2) - 2) {}
  KOKKOS_FORCEINLINE_FUNCTION bool is_forward() const { return dx > 0 || (dx == 0 && dz > 0); }
};

/// Walks the candidates of one grain and calls f(j) for each within the extents of both.
struct PairSearch {
  SearchColumns columns;
  Kokkos::View<const GrainKinematics*> grains;
  OccupiedColumns occupied;
  Windows window;
  PeriodicBox box;
  int n_owned = 0;  // entries from here on are ghosts; two of them are no pair of this rank

  KOKKOS_FORCEINLINE_FUNCTION int entry(int i) const { return i; }
  /// Calls action(j) for the near partners in column c, from entry `begin` on.
  template <class Action>
  KOKKOS_FORCEINLINE_FUNCTION void scan(int i, int c, int begin, const Action& action) const {
    const GrainKinematics& a = grains(i);
    const Real own = columns.extent(a), highest = a.x.y + (own + occupied.widest(c));
    const int end = occupied.start(c + 1);
    for (int j = begin; j < end; ++j) {
      const GrainKinematics& b = grains(j);
      if (b.x.y > highest) break;  // sorted by height
      const Vec3 s = box.nearest_image(a.x - b.x);
      const Real cutoff = own + columns.extent(b);
      if (dot(s, s) < cutoff * cutoff && (i < n_owned || j < n_owned)) action(j);
    }
  }
  template <class Action>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_partner(int i, const Action& action) const {
    const int c = occupied.of_grain(i);
    scan(i, c, i + 1, action);
    for (int m = 0; m < kForwardColumns; ++m) {
      const int other = occupied.forward(c, m);
      if (other >= 0) scan(i, other, window(i, m), action);
    }
    if (columns.is_wide(grains(i))) scan_outer_ring(i, c, action);
  }

 private:
  /// Scans the outer ring. The wide grain of a pair finds it; if both are wide, the one that has
  /// the other in front.
  template <class Action>
  KOKKOS_FUNCTION void scan_outer_ring(int i, int c, const Action& action) const {
    for (int m = 0; m < kOuterColumns; ++m) {
      const OuterColumn at(m);
      std::uint32_t id = 0;
      if (!columns.neighbor(occupied.id(c), at.dx, at.dz, id)) continue;
      const int other = occupied.find(id);
      if (other < 0) continue;
      scan(i, other, occupied.start(other), [&](int j) {
        if (at.is_forward() || !columns.is_wide(grains(j))) action(j);
      });
    }
  }
};

/// The same among spheres of clumps: two of one clump are no pair. A rank may have a sphere in a
/// column of another one and a ghost in one of its own, so places in the order of the columns are
/// other numbers than entries.
struct ClumpPairSearch {
  PairSearch places;                        // all of whose places count as owned
  Kokkos::View<const int*> entry_of_place;  // empty: they are the same
  Kokkos::View<const std::int64_t*> id;
  int n_owned = 0;

  KOKKOS_FORCEINLINE_FUNCTION int entry(int place) const {
    return entry_of_place.extent(0) > 0 ? entry_of_place(place) : place;
  }
  template <class Action>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_partner(int place, const Action& action) const {
    const int i = entry(place);
    const std::int64_t clump = clump_of_id(id(i));
    places.for_each_partner(place, [&](int other) {
      const int j = entry(other);
      if ((i < n_owned || j < n_owned) && clump_of_id(id(j)) != clump) action(j);
    });
  }
};

/// Number of partners that the counting pass notes down, so that few grains are searched twice.
inline constexpr int kNoted = 8;
using NotedPartners = Kokkos::View<int* [kNoted], Kokkos::MemoryUnmanaged>;

/// Counts the partners of each grain, in its own chunk and in others; notes the first of them.
template <class Finder>
struct CountPairs {
  Finder search;
  Chunks chunks;
  Kokkos::View<int*> inter, intra;
  NotedPartners noted;
  KOKKOS_FUNCTION void operator()(int place) const {
    const int i = search.entry(place);
    int n = 0, n_intra = 0;
    search.for_each_partner(place, [&](int j) {
      if (n < kNoted) noted(i, n) = j;
      ++n;
      n_intra += chunks.contain_both(i, j) ? 1 : 0;
    });
    inter(i) = n - n_intra;
    intra(i) = n_intra;
  }
};

/// Writes the pairs of each grain and their contact history. `old_entry` is the entry under which
/// `history` has each owned grain.
template <class Finder>
struct FillPairs {
  Finder search;
  NotedPartners noted;
  PairList list;
  ContactHistory history;
  Kokkos::View<const int*> old_entry;
  Kokkos::View<const std::int64_t*> id;
  Kokkos::View<const std::uint8_t*> kind;  // kinds of the grains; empty: one kind
  bool has_history = false;

  KOKKOS_FUNCTION void operator()(int place) const {
    const int i = search.entry(place);
    int inter = list.first(i), intra = list.intra_first(i);
    const int n = list.first(i + 1) - inter + list.intra_first(i + 1) - intra;
    const auto add = [&](int j) {
      const int slot = list.chunks.contain_both(i, j) ? intra++ : inter++;
      list.i(slot) = i;
      list.j(slot) = j;
      if (list.has_laws()) list.law(slot) = law_entry(kind(i), kind(j));
      remember(slot, i, j);
    };
    if (n > kNoted) {
      search.for_each_partner(place, add);
    } else {
      for (int s = 0; s < n; ++s) add(noted(i, s));
    }
  }
  KOKKOS_FUNCTION void remember(int slot, int i, int j) const {
    int k = -1;
    Real sign = 1;
    if (has_history) {
      const int n_owned = list.chunks.n;
      if (i < n_owned) k = history.find(old_entry(i), id(j));
      if (k < 0 && j < n_owned) {
        k = history.find(old_entry(j), id(i));
        sign = -1;  // forces and displacements are those of the first grain
      }
    }
    const bool known = k >= 0;
    list.touching(slot) = known ? 1 : 0;
    list.xi_t(slot) = known ? sign * history.xi_t(k) : Vec3{};
    if (list.has_rolling()) list.rolling(slot) = known ? sign * history.rolling(k) : Vec3{};
    if (list.has_force()) {
      const bool has = known && history.has_force();  // restart files have no forces
      list.force(slot) = has ? sign * history.force(k) : Vec3{};
    }
    if (slot < list.n_inter) list.pair_force(slot) = PairForce{};
  }
};

/// Registers each inter-chunk slot with its second grain; `cursor` holds the next free entry of
/// each grain.
struct FillIncoming {
  PairList list;
  Kokkos::View<int*> cursor;
  KOKKOS_FUNCTION void operator()(int slot) const {
    list.incoming(Kokkos::atomic_fetch_add(&cursor(list.j(slot)), 1)) = slot;
  }
};

/// Sorts each grain's other slots in ascending order, whatever order the threads came in.
struct SortIncoming {
  PairList list;
  KOKKOS_FUNCTION void operator()(int g) const {
    const int begin = list.incoming_first(g), end = list.incoming_first(g + 1);
    for (int a = begin + 1; a < end; ++a) {
      const int slot = list.incoming(a);
      int b = a;
      for (; b > begin && list.incoming(b - 1) > slot; --b) {
        list.incoming(b) = list.incoming(b - 1);
      }
      list.incoming(b) = slot;
    }
  }
};

}  // namespace barchan
