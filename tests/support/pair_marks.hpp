// Marks in the place of contact histories, which tell whose they are.
#pragma once

#include "src/grains/grain_state.hpp"

namespace barchan::testing {

/// Moves every grain by `distance` [m] along its velocity.
inline void drift(const GrainState& s, Real distance) {
  const auto kin = s.kin;
  Kokkos::parallel_for(
      "test: drift", s.n,
      KOKKOS_LAMBDA(int g) { kin(g).x += (distance / norm(kin(g).u)) * kin(g).u; });
}

/// Marks each pair with its ids, seen from the grain of lower id; or counts the touching pairs
/// whose marks are wrong.
inline int handle_marks(const GrainState& s, bool write) {
  const PairList l = s.list;
  const auto id = s.id;
  int wrong = 0;
  Kokkos::parallel_reduce(
      "test: marks", l.n_pairs,
      KOKKOS_LAMBDA(int p, int& errors) {
        const auto a = static_cast<Real>(id(l.i(p))), b = static_cast<Real>(id(l.j(p)));
        const Real sign = a < b ? 1 : -1;
        const Vec3 expected = sign * Vec3{Kokkos::min(a, b), Kokkos::max(a, b), 1};
        if (write) {
          l.xi_t(p) = expected;
          l.rolling(p) = Real(2) * expected;
          l.force(p) = Real(3) * expected;
          l.touching(p) = 1;
        } else if (l.touching(p)) {
          errors += norm(l.xi_t(p) - expected) > 0 || norm(l.rolling(p) - Real(2) * expected) > 0 ||
                    norm(l.force(p) - Real(3) * expected) > 0;
        }
      },
      wrong);
  return wrong;
}

}  // namespace barchan::testing
