#include "perf/bandwidth.hpp"

#include <algorithm>
#include <chrono>

#include "perf/options.hpp"

namespace barchan {

namespace {

Kokkos::View<Real*> triad_array(const char* label) {
  const std::size_t n = options().tiny ? 1 << 16 : 1 << 24;
  return Kokkos::View<Real*>(label, n);  // first touched by the threads that will use it
}

}  // namespace

Triad::Triad()
    : a_(triad_array("triad a")), b_(triad_array("triad b")), c_(triad_array("triad c")) {}

void Triad::run() const {
  const auto a = a_, b = b_, c = c_;
  Kokkos::parallel_for(
      "triad", a.extent(0), KOKKOS_LAMBDA(std::size_t i) { a(i) = b(i) + Real(3) * c(i); });
}

double measured_bandwidth() {
  static const double best = [] {
    const Triad triad;
    double shortest = 1e300;
    for (int pass = 0; pass < 10; ++pass) {
      Kokkos::fence("before a triad");
      const auto start = std::chrono::steady_clock::now();
      triad.run();
      Kokkos::fence("after a triad");
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      shortest = std::min(shortest, took.count());
    }
    return triad.bytes() / shortest;
  }();
  return best;
}

}  // namespace barchan
