// Skins of grains: the distance that each may move until the neighbour list is searched again.
#pragma once

#include <cstdint>

#include "kernels/grains/grain.hpp"

namespace barchan {

/// Time [s] that skins can last which are at least `least` wide (at rest) and at most `largest`
/// [m]: as long as the fastest grain needs for the largest skin. It is shorter where so many grains
/// are fast, `mean` [m/s], that skins would on average be more than half as wide again as at rest.
KOKKOS_INLINE_FUNCTION Real skin_horizon(Real least, Real largest, Real fastest, Real mean) {
  return Kokkos::min((largest - least) / fastest, least / 2 / mean);
}

/// Sets the skins of the grains: the distance that each goes in the same time at its present speed,
/// plus what it may gain meanwhile. A few fast grains then do not wear out the list of a bed at
/// rest.
struct SetSkins {
  Real least = 0, largest = 0;  // the first is the skin of a grain at rest [m]
  Real horizon = 0;             // time that the skins last [s]
  Kokkos::View<GrainKinematics*> grains;
  Kokkos::View<Vec3*> from;  // positions now [m]
  KOKKOS_FUNCTION void operator()(int g) const {
    from(g) = grains(g).x;
    grains(g).skin = Kokkos::min(least + horizon * norm(grains(g).u), largest);
  }
};

/// Counts skins that are not within these bounds.
struct CountSkinsOutOfRange {
  Real least = 0, largest = 0;  // [m]
  Kokkos::View<const GrainKinematics*> grains;
  KOKKOS_FUNCTION void operator()(int g, int& n) const {
    const Real skin = grains(g).skin;
    n += skin < least || skin > largest ? 1 : 0;  // other checks find values that are not numbers
  }
};

/// Largest speed [m/s], and the sum of all speeds in whole parts of `unit`: the same in any order.
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
