// Random numbers from counters: the same on any rank and after any restart.
#pragma once

#include <cstdint>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Output of the generator SplitMix64 in a state. Steele, Lea & Flood, Proc. OOPSLA 2014, 453.
KOKKOS_FORCEINLINE_FUNCTION constexpr std::uint64_t splitmix64(std::uint64_t state) {
  std::uint64_t z = state + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

/// Random number in [0, 1) for each `count` of a `purpose`, all of them independent.
KOKKOS_FORCEINLINE_FUNCTION constexpr Real uniform_number(std::uint64_t seed, std::uint64_t purpose,
                                                          std::uint64_t count) {
  const std::uint64_t bits = splitmix64(splitmix64(splitmix64(seed) + purpose) + count);
  return static_cast<Real>(bits >> 11) * 0x1p-53;
}

}  // namespace barchan
