// Contact laws by the kinds of the two sides.
#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/grains/contact_law.hpp"

namespace barchan {

/// Largest number of kinds of grains in a table.
inline constexpr int kMaxKinds = 4;

/// Entry of a contact of kind a with kind b, or with the walls (b = 0), in a table of many.
KOKKOS_FORCEINLINE_FUNCTION constexpr std::uint8_t law_entry(int a, int b) {
  return static_cast<std::uint8_t>(a * kMaxKinds + b);
}

/// Table of stiffness and friction of contacts. One kind of grains has one entry, and no index is
/// read: the instructions are those of a code without a table.
template <class StiffnessLaw, bool many>
struct LawTable {
  static constexpr int kSize = many ? kMaxKinds * kMaxKinds : 1;
  StiffnessLaw stiffness[kSize];
  Friction friction[kSize];

  KOKKOS_FORCEINLINE_FUNCTION static int at(std::uint8_t entry) { return many ? entry : 0; }
  KOKKOS_FORCEINLINE_FUNCTION const StiffnessLaw& of(std::uint8_t entry) const {
    return stiffness[at(entry)];
  }
};

/// The law of contacts between grains, or of grains with walls, and its grain step.
template <class StiffnessLaw, class RollingLaw, bool many = false>
struct ContactLaw {
  using Stiffness = StiffnessLaw;
  using Rolling = RollingLaw;
  static constexpr bool kMany = many;
  static constexpr bool kRolls = !std::is_same_v<Rolling, NoRolling>;

  LawTable<Stiffness, many> table;
  Rolling rolling;
  Real dt = 0;  // [s]
};

}  // namespace barchan
