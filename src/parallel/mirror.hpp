// Arrays of the device, for the host.
#pragma once

#include "kernels/math/on_host.hpp"

namespace barchan {

/// An array for the host of a view's shape; where the host reaches the view, the view itself. In a
/// rehearsal always one of its own, so that a missing copy shows.
template <class View>
auto mirror(const View& view) {
  if constexpr (kRehearsal)
    return Kokkos::create_mirror(view);
  else
    return Kokkos::create_mirror_view(view);
}

/// With the view's numbers.
template <class View>
auto host_copy(const View& view) {
  const auto host = mirror(view);
  Kokkos::deep_copy(host, view);
  return host;
}

}  // namespace barchan
