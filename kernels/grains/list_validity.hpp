// Validity of a neighbour list.
#pragma once

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Square of the displacement since the list was searched, minus that of a grain's skin [m^2]. A
/// value that is not a number counts as infinite: the next rebuild meets and reports it.
KOKKOS_FORCEINLINE_FUNCTION Real excess_over_skin(const Vec3& displacement, Real skin) {
  const Real excess = dot(displacement, displacement) - skin * skin;
  return excess == excess ? excess : Kokkos::Experimental::infinity_v<Real>;
}

/// Lets a grain step go ahead while no grain has moved farther than its skin. A host that waits for
/// a device only now and then launches grain steps ahead of that knowledge; steps behind a stale
/// list then do nothing.
struct ListValidity {
  Kokkos::View<const Real*> excess;  // largest of all grains [m^2] ...
  int before = 0;                    // ... as this grain step begins: in this element
  KOKKOS_FORCEINLINE_FUNCTION bool holds() const { return excess(before) <= 0; }
};

}  // namespace barchan
