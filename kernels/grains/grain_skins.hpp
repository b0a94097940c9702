// How far each grain may move until the neighbour list is searched again.
#pragma once

#include <cstdint>

#include "kernels/grains/grain.hpp"

namespace barchan {

/// For how long skins can last [s] that are `least` wide at rest and `largest` at most [m]: as long
/// as the fastest grain needs for the largest skin; shorter where so many are fast, `mean` [m/s],
/// that skins would on average be more than half as wide again as at rest.
KOKKOS_INLINE_FUNCTION Real skin_horizon(Real least, Real largest, Real fastest, Real mean) {
  return Kokkos::min((largest - least) / fastest, least / 2 / mean);
}

/// Skins of the grains: as far as each comes in the same time at the speed that it has, and beyond
/// that what it may gain meanwhile. A few fast grains then do not wear out the list of a bed at
/// rest.
struct SetSkins {
  Real least = 0, largest = 0;  // the first is that of a grain at rest [m]
  Real horizon = 0;             // that time [s]
  Kokkos::View<GrainKinematics*> grains;
  Kokkos::View<Vec3*> from;  // where they are now [m]
  KOKKOS_FUNCTION void operator()(int g) const {
    from(g) = grains(g).x;
    grains(g).skin = Kokkos::min(least + horizon * norm(grains(g).u), largest);
  }
};

/// How many skins are not those of a list with these bounds.
struct CountSkinsOutOfRange {
  Real least = 0, largest = 0;  // [m]
  Kokkos::View<const GrainKinematics*> grains;
  KOKKOS_FUNCTION void operator()(int g, int& n) const {
    const Real skin = grains(g).skin;
    n += skin < least || skin > largest ? 1 : 0;  // what is not a number is found by others
  }
};

/// Largest speed [m/s], and the sum of all in parts of `unit`, whole numbers: the same in any
/// order.
struct SpeedsOfGrains {
  Kokkos::View<const GrainKinematics*> grains;
  Real unit = 1;  // [m/s]
  KOKKOS_FUNCTION void operator()(int g, Real& largest) const {
    largest = Kokkos::max(largest, norm(grains(g).u));
  }
  KOKKOS_FUNCTION void operator()(int g, std::int64_t& sum) const {
    const Real parts = norm(grains(g).u) / unit;
    if (parts == parts) sum += static_cast<std::int64_t>(parts);
  }
};

}  // namespace barchan
