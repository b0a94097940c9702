// Columns for the neighbour search: grains are binned in x-z columns and sorted by height inside a
// column. Only columns that hold grains exist, so empty fluid costs nothing. Columns are numbered
// along a Morton curve, so that grains of near rows are near in space; each rank owns a piece of
// the curve.
#pragma once

#include <cstdint>

#include "kernels/grains/grain.hpp"

namespace barchan {

/// Bits of a 16-bit number moved to the even positions, and back.
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

/// Largest number of columns along one direction.
inline constexpr int kMaxColumns = 65535;

/// The x-z columns of the domain. The partners of a grain are in its column and the `rings` of
/// columns around it; those of two grains that are not wide, in the first ring. Numbers of columns
/// begin with that of the column at `origin`, those before it follow at the end: the columns of a
/// rank, a piece of the Morton curve from `origin` on, come before those of others.
struct SearchColumns {
  int nx = 1, nz = 1;
  int rings = 1;        // 1 or 2
  Real max_narrow = 0;  // largest extent of a grain that is not wide [m]
  Real half_reach = 0;  // half the reach of the contact law between two surfaces [m]
  Real inverse_width_x = 0, inverse_width_z = 0;  // [1/m]
  Real height = 0;                                // scale of the y part of the key [m]
  bool periodic_x = false, periodic_z = false;
  std::uint32_t origin = 0;  // position on the Morton curve
  int arms = 0;  // columns from the centre of a clump to its farthest sphere: 0 to kMostArms

  /// Number on the Morton curve of the column around a position.
  KOKKOS_FUNCTION std::uint32_t morton_code_of(const Vec3& x) const {
    const int ix = Kokkos::clamp(static_cast<int>(x.x * inverse_width_x), 0, nx - 1);
    const int iz = Kokkos::clamp(static_cast<int>(x.z * inverse_width_z), 0, nz - 1);
    return code_of(ix, iz);
  }
  KOKKOS_FUNCTION std::uint32_t column_of(const Vec3& x) const {
    return morton_code_of(x) - origin;
  }
  KOKKOS_FUNCTION static std::uint32_t code_of(int ix, int iz) {
    return (spread_bits(static_cast<std::uint32_t>(ix)) << 1) |
           spread_bits(static_cast<std::uint32_t>(iz));
  }
  /// Sort key: column, then height. The largest key marks grains to be dropped.
  KOKKOS_FUNCTION std::uint64_t key_of(const Vec3& x) const {
    // Heights range from -1 to 2 domain heights.
    const Real level = Kokkos::clamp((x.y / height + 1) / 3, Real(0), Real(1));
    const auto code = static_cast<std::uint64_t>(level * Real(4294967295.0));
    return (static_cast<std::uint64_t>(column_of(x)) << 32) | code;
  }
  /// Radius, skin and half the reach of the law: pairs closer than the sum of two are listed [m].
  KOKKOS_FORCEINLINE_FUNCTION Real extent(const GrainKinematics& grain) const {
    return grain.r + grain.skin + half_reach;
  }
  KOKKOS_FORCEINLINE_FUNCTION bool is_wide(const GrainKinematics& grain) const {
    return rings > 1 && extent(grain) > max_narrow;
  }
  /// Column at an offset of (dx, dz) columns; false outside the domain.
  KOKKOS_FUNCTION bool neighbor(std::uint32_t column, int dx, int dz, std::uint32_t& result) const {
    const std::uint32_t code = column + origin;
    int ix = static_cast<int>(gather_bits(code >> 1)) + dx;
    int iz = static_cast<int>(gather_bits(code)) + dz;
    if (periodic_x) ix = (ix + 2 * nx) % nx;
    if (periodic_z) iz = (iz + 2 * nz) % nz;
    if (ix < 0 || ix >= nx || iz < 0 || iz >= nz) return false;
    result = code_of(ix, iz) - origin;
    return true;
  }
};

/// Number of those of n ascending values that are at most `value`.
template <class Values>
KOKKOS_FUNCTION int count_up_to(const Values& ascending, int n, std::uint32_t value) {
  int low = 0, high = n;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (ascending(middle) <= value) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

inline constexpr std::uint64_t kDroppedKey = ~std::uint64_t{0};
inline constexpr int kForwardColumns = 4;  // half of the eight columns around one
inline constexpr int kOuterColumns = 16;   // columns of the ring around these

/// The columns that hold grains, in key order.
struct OccupiedColumns {
  int n = 0;
  Kokkos::View<std::uint32_t*> id;               // (n) ascending
  Kokkos::View<int*> start;                      // (n + 1) first grain of each
  Kokkos::View<int*> of_grain;                   // (grains) occupied column of each grain
  Kokkos::View<int* [kForwardColumns]> forward;  // (n) occupied column or -1
  Kokkos::View<Real*> widest;                    // (n) largest extent [m]

  /// Position of a column id in `id`, or -1.
  KOKKOS_FUNCTION int find(std::uint32_t column) const {
    const int c = count_up_to(id, n, column) - 1;
    return c >= 0 && id(c) == column ? c : -1;
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

/// Fills `forward`, half of the neighbouring columns, so that each pair is met once; and `widest`.
struct LinkColumns {
  SearchColumns columns;
  Kokkos::View<const GrainKinematics*> grains;
  OccupiedColumns occupied;

  KOKKOS_FUNCTION void operator()(int c) const {
    Real widest = 0;
    for (int g = occupied.start(c); g < occupied.start(c + 1); ++g)
      widest = Kokkos::max(widest, columns.extent(grains(g)));
    occupied.widest(c) = widest;
    const int dx[kForwardColumns] = {0, 1, 1, 1};
    const int dz[kForwardColumns] = {1, -1, 0, 1};
    for (int m = 0; m < kForwardColumns; ++m) {
      std::uint32_t other = 0;
      const bool exists = columns.neighbor(occupied.id(c), dx[m], dz[m], other);
      occupied.forward(c, m) = exists ? occupied.find(other) : -1;
    }
  }
};

/// Owners of columns: rank r has those from code start(r) on the Morton curve up to start(r + 1);
/// start(0) is 0. A rank that starts where the next one does owns nothing.
struct GrainOwners {
  int me = 0;
  Kokkos::View<const std::uint32_t*> start;  // (ranks)

  KOKKOS_FUNCTION int of_code(std::uint32_t code) const {
    return count_up_to(start, start.extent_int(0), code) - 1;
  }
};

/// Largest number of columns from the centre of a clump to its farthest sphere.
inline constexpr int kMostArms = 4;

/// Destinations of a grain's copies: the other ranks that own a column in the rings around its own,
/// and with clumps those whose spheres may reach into these columns.
struct GhostDestinations {
  static constexpr int kWidth = 2 * (2 + kMostArms) + 1;
  static constexpr int kMax = kWidth * kWidth - 1;
  int n = 0;
  int rank[kMax];

  KOKKOS_FUNCTION GhostDestinations(const SearchColumns& columns, const GrainOwners& owners,
                                    const Vec3& x) {
    const std::uint32_t column = columns.column_of(x);
    const int reach = columns.rings + columns.arms;
    for (int dx = -reach; dx <= reach; ++dx) {
      for (int dz = -reach; dz <= reach; ++dz) {
        std::uint32_t other = 0;
        if (!columns.neighbor(column, dx, dz, other)) continue;
        add(owners.of_code(other + columns.origin), owners.me);
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
