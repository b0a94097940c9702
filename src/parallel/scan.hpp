// Parallel scans.
#pragma once

#include <Kokkos_Core.hpp>

#include <string>

namespace barchan {

/// Runs a parallel scan of counts; their total. Without work it is 0: there a device leaves the
/// result of a scan as it was.
template <class Policy, class Functor>
int scan(const std::string& label, const Policy& policy, const Functor& functor) {
  int total = 0;
  Kokkos::parallel_scan(label, policy, functor, total);
  return total;
}

}  // namespace barchan
