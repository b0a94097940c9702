// Bandwidth at which this machine streams memory.
#pragma once

#include <Kokkos_Core.hpp>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Triad a = b + s c over arrays larger than any cache, as in STREAM: 24 bytes an element.
class Triad {
 public:
  Triad();
  double elements() const { return static_cast<double>(a_.extent(0)); }
  double bytes() const { return 3 * sizeof(Real) * elements(); }
  void run() const;

 private:
  Kokkos::View<Real*> a_, b_, c_;
};

/// Bandwidth, the best of ten passes [bytes/s], measured at the first call.
double measured_bandwidth();

}  // namespace barchan
