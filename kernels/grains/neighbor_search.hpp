// Neighbour search in columns: grains are binned in x-z columns and sorted by height inside a
// column, so only columns that hold grains exist and empty water costs nothing. SearchColumns are
// numbered along a Morton curve, so that grains of near rows are near in space.
#pragma once

#include <cstdint>

#include "kernels/grains/contact_history.hpp"
#include "kernels/grains/grain.hpp"

namespace barchan {

/// Bits of a 16-bit number moved to the even places, and back.
KOKKOS_FORCEINLINE_FUNCTION constexpr std::uint32_t spread_bits(std::uint32_t a) {
  a = (a | (a << 8)) & 0x00ff00ffu;
  a = (a | (a << 4)) & 0x0f0f0f0fu;
  a = (a | (a << 2)) & 0x33333333u;
  return (a | (a << 1)) & 0x55555555u;
}
KOKKOS_FORCEINLINE_FUNCTION constexpr std::uint32_t gather_bits(std::uint32_t a) {
  a &= 0x55555555u;
  a = (a | (a >> 1)) & 0x33333333u;
  a = (a | (a >> 2)) & 0x0f0f0f0fu;
  a = (a | (a >> 4)) & 0x00ff00ffu;
  return (a | (a >> 8)) & 0x0000ffffu;
}

/// Columns along one direction, at most.
inline constexpr int kMaxColumns = 65535;

/// The x-z columns of the domain, each at least one cutoff wide. Their numbers begin with that of
/// the column at `origin`, those before it follow at the end: the columns of a rank, a piece of the
/// Morton curve from `origin` on, come before those of others.
struct SearchColumns {
  int nx = 1, nz = 1;
  Real inverse_width_x = 0, inverse_width_z = 0;  // [1/m]
  Real height = 0;                                // scale of the y part of the key [m]
  bool periodic_x = false, periodic_z = false;
  std::uint32_t origin = 0;  // place on the Morton curve

  KOKKOS_FUNCTION static int clamp(int a, int n) { return a < 0 ? 0 : (a >= n ? n - 1 : a); }

  /// Place of a position on the Morton curve.
  KOKKOS_FUNCTION std::uint32_t place_of(const Vec3& x) const {
    const int ix = clamp(static_cast<int>(x.x * inverse_width_x), nx);
    const int iz = clamp(static_cast<int>(x.z * inverse_width_z), nz);
    return code_of(ix, iz);
  }
  KOKKOS_FUNCTION std::uint32_t column_of(const Vec3& x) const { return place_of(x) - origin; }
  KOKKOS_FUNCTION static std::uint32_t code_of(int ix, int iz) {
    return (spread_bits(static_cast<std::uint32_t>(ix)) << 1) |
           spread_bits(static_cast<std::uint32_t>(iz));
  }
  /// Sort key: column, then height. The largest key is kept for grains to be dropped.
  KOKKOS_FUNCTION std::uint64_t key_of(const Vec3& x) const {
    Real level = (x.y / height + 1) / 3;  // heights of -1 .. 2 domain heights
    level = level < 0 ? 0 : (level > 1 ? 1 : level);
    const auto code = static_cast<std::uint64_t>(level * Real(4294967295.0));
    return (static_cast<std::uint64_t>(column_of(x)) << 32) | code;
  }
  /// Column at an offset of (dx, dz) columns; false outside the domain.
  KOKKOS_FUNCTION bool neighbor(std::uint32_t column, int dx, int dz, std::uint32_t& result) const {
    const std::uint32_t place = column + origin;
    int ix = static_cast<int>(gather_bits(place >> 1)) + dx;
    int iz = static_cast<int>(gather_bits(place)) + dz;
    if (periodic_x) ix = (ix + nx) % nx;
    if (periodic_z) iz = (iz + nz) % nz;
    if (ix < 0 || ix >= nx || iz < 0 || iz >= nz) return false;
    result = code_of(ix, iz) - origin;
    return true;
  }
};

inline constexpr std::uint64_t kDroppedKey = ~std::uint64_t{0};
inline constexpr int kForwardColumns = 4;  // half of the eight columns around one

/// The columns that hold grains, in key order.
struct OccupiedColumns {
  int n = 0;
  Kokkos::View<std::uint32_t*> id;               // (n) ascending
  Kokkos::View<int*> start;                      // (n + 1) first grain of each
  Kokkos::View<int*> of_grain;                   // (grains) occupied column of each grain
  Kokkos::View<int* [kForwardColumns]> forward;  // (n) occupied column or -1

  /// Position of a column id in `id`, or -1.
  KOKKOS_FUNCTION int find(std::uint32_t column) const {
    int low = 0, high = n;
    while (low < high) {
      const int middle = (low + high) / 2;
      if (id(middle) < column) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low < n && id(low) == column ? low : -1;
  }
};

/// Numbers the occupied columns along grains in key order: `of_grain`, and how many there are.
struct NumberColumns {
  SearchColumns columns;
  Kokkos::View<const GrainKinematics*> grains;
  OccupiedColumns occupied;

  KOKKOS_FORCEINLINE_FUNCTION bool opens(int g) const {
    return g == 0 || columns.column_of(grains(g).x) != columns.column_of(grains(g - 1).x);
  }
  KOKKOS_FUNCTION void operator()(int g, int& count, bool final) const {
    count += opens(g) ? 1 : 0;
    if (final) occupied.of_grain(g) = count - 1;
  }
};

/// Fills `id` and `start` but for its last entry.
struct StartColumns {
  SearchColumns columns;
  Kokkos::View<const GrainKinematics*> grains;
  OccupiedColumns occupied;

  KOKKOS_FUNCTION void operator()(int g) const {
    const int c = occupied.of_grain(g);
    if (g > 0 && occupied.of_grain(g - 1) == c) return;
    occupied.id(c) = columns.column_of(grains(g).x);
    occupied.start(c) = g;
  }
};

/// Fills `forward`: half of the neighbouring columns, so that each pair is met once.
struct LinkColumns {
  SearchColumns columns;
  OccupiedColumns occupied;

  KOKKOS_FUNCTION void operator()(int c) const {
    const int dx[kForwardColumns] = {0, 1, 1, 1};
    const int dz[kForwardColumns] = {1, -1, 0, 1};
    for (int m = 0; m < kForwardColumns; ++m) {
      std::uint32_t other = 0;
      const bool exists = columns.neighbor(occupied.id(c), dx[m], dz[m], other);
      occupied.forward(c, m) = exists ? occupied.find(other) : -1;
    }
  }
};

/// Where grain i starts to look in the forward columns: grains below are too far down.
using Windows = Kokkos::View<int* [kForwardColumns], Kokkos::MemoryUnmanaged>;

/// Fills the windows of the grains of a column, walking up all five columns together: O(grains).
struct FindWindows {
  Kokkos::View<const GrainKinematics*> grains;
  OccupiedColumns occupied;
  Windows window;
  Real reach = 0;  // largest sum of two radii + skin [m]

  KOKKOS_FUNCTION void operator()(int c) const {
    for (int m = 0; m < kForwardColumns; ++m) {
      const int other = occupied.forward(c, m);
      if (other < 0) continue;
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

/// Walks the candidates of one grain and calls f(j) for each within r_i + r_j + skin.
struct PairSearch {
  Kokkos::View<const GrainKinematics*> grains;
  OccupiedColumns occupied;
  Windows window;
  PeriodicBox box;
  Real skin = 0;    // [m]
  Real r_max = 0;   // largest radius [m]
  int n_owned = 0;  // rows from here on are ghosts; two of them are no pair of this rank

  template <class Action>
  KOKKOS_FORCEINLINE_FUNCTION void scan(int i, int begin, int end, const Action& action) const {
    const GrainKinematics& a = grains(i);
    const Real highest = a.x.y + (a.r + r_max + skin);
    for (int j = begin; j < end; ++j) {
      const GrainKinematics& b = grains(j);
      if (b.x.y > highest) break;  // sorted by height
      const Vec3 s = box.nearest_image(a.x - b.x);
      const Real cutoff = a.r + b.r + skin;
      if (dot(s, s) < cutoff * cutoff && (i < n_owned || j < n_owned)) action(j);
    }
  }
  template <class Action>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_partner(int i, const Action& action) const {
    const int c = occupied.of_grain(i);
    scan(i, i + 1, occupied.start(c + 1), action);
    for (int m = 0; m < kForwardColumns; ++m) {
      const int other = occupied.forward(c, m);
      if (other >= 0) scan(i, window(i, m), occupied.start(other + 1), action);
    }
  }
};

/// Partners that the counting pass notes down, so that few grains are searched twice.
inline constexpr int kNoted = 8;
using NotedPartners = Kokkos::View<int* [kNoted], Kokkos::MemoryUnmanaged>;

/// Number of partners of each grain, in its own chunk and in others; notes the first of them.
struct CountPairs {
  PairSearch search;
  Chunks chunks;
  Kokkos::View<int*> crossing, inner;
  NotedPartners noted;
  KOKKOS_FUNCTION void operator()(int i) const {
    int n = 0, n_inner = 0;
    search.for_each_partner(i, [&](int j) {
      if (n < kNoted) noted(i, n) = j;
      ++n;
      n_inner += chunks.together(i, j) ? 1 : 0;
    });
    crossing(i) = n - n_inner;
    inner(i) = n_inner;
  }
};

/// Writes the pairs of each grain and what they remember. `old_row` is the row under which `kept`
/// has each owned grain.
struct FillPairs {
  PairSearch search;
  NotedPartners noted;
  PairList list;
  ContactHistory kept;
  Kokkos::View<const int*> old_row;
  Kokkos::View<const std::int64_t*> id;
  bool has_kept = false;

  KOKKOS_FUNCTION void operator()(int i) const {
    int crossing = list.first(i), inner = list.inner_first(i);
    const int n = list.first(i + 1) - crossing + list.inner_first(i + 1) - inner;
    const auto place = [&](int j) {
      const int slot = list.chunks.together(i, j) ? inner++ : crossing++;
      list.i(slot) = i;
      list.j(slot) = j;
      remember(slot, i, j);
    };
    if (n > kNoted) {
      search.for_each_partner(i, place);
    } else {
      for (int s = 0; s < n; ++s) place(noted(i, s));
    }
  }
  KOKKOS_FUNCTION void remember(int slot, int i, int j) const {
    int k = -1;
    Real sign = 1;
    if (has_kept) {
      const int n_owned = list.chunks.n;
      if (i < n_owned) k = kept.find(old_row(i), id(j));
      if (k < 0 && j < n_owned) {
        k = kept.find(old_row(j), id(i));
        sign = -1;  // forces and displacements are those of the first grain
      }
    }
    const bool known = k >= 0;
    list.touching(slot) = known ? 1 : 0;
    list.xi_t(slot) = known ? sign * kept.xi_t(k) : Vec3{};
    if (list.has_rolling()) list.rolling(slot) = known ? sign * kept.rolling(k) : Vec3{};
    if (list.has_force()) {
      const bool has = known && kept.has_force();  // restart files do without
      list.force(slot) = has ? sign * kept.force(k) : Vec3{};
    }
    if (slot < list.n_crossing) list.pair_force(slot) = PairForce{};
  }
};

/// Registers each crossing slot with its second grain; `cursor` holds the next free place of each
/// grain.
struct RegisterOthers {
  PairList list;
  Kokkos::View<int*> cursor;
  KOKKOS_FUNCTION void operator()(int slot) const {
    const int place = Kokkos::atomic_fetch_add(&cursor(list.j(slot)), 1);
    list.other_slot(place) = slot;
  }
};

/// Ascending order of each grain's other slots, whatever order the threads came in.
struct SortOthers {
  PairList list;
  KOKKOS_FUNCTION void operator()(int g) const {
    const int begin = list.other_first(g), end = list.other_first(g + 1);
    for (int a = begin + 1; a < end; ++a) {
      const int slot = list.other_slot(a);
      int b = a;
      for (; b > begin && list.other_slot(b - 1) > slot; --b) {
        list.other_slot(b) = list.other_slot(b - 1);
      }
      list.other_slot(b) = slot;
    }
  }
};

}  // namespace barchan
