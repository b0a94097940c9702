// Copies of a device's arrays on the host, and the other way.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "kernels/math/on_host.hpp"

namespace barchan {

/// Array for the host of a view's shape; where the host reaches the view, the view itself. In a
/// rehearsal it is always a separate array, so that a missing copy shows.
template <class View>
auto mirror(const View& view) {
  if constexpr (kRehearsal)
    return Kokkos::create_mirror(view);
  else
    return Kokkos::create_mirror_view(view);
}

/// Array for the host with the view's numbers.
template <class View>
auto host_copy(const View& view) {
  const auto host = mirror(view);
  Kokkos::deep_copy(host, view);
  return host;
}

/// Copy on the device, with room for `least` entries.
template <class T>
Kokkos::View<T*> to_device(const std::string& label, const std::vector<T>& values,
                           std::size_t least = 0) {
  const Kokkos::View<T*> view(label, std::max(values.size(), least));
  const auto host = mirror(view);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(view, host);
  return view;
}

}  // namespace barchan
