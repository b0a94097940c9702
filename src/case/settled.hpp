// Case with all that follows from it, made once: a run, its estimate and its checks read it here.
#pragma once

#include <vector>

#include "src/case/config.hpp"
#include "src/case/derived.hpp"

namespace barchan {

struct SettledCase {
  SettledCase() = default;
  /// Settles a `config` that has passed validate. `sizes`: of its grains, empty where they are not
  /// known; `top`: their highest point [m], 0: not known.
  // NOLINTNEXTLINE(google-explicit-constructor): a case alone will do where sizes do not matter
  SettledCase(const Config& config, const std::vector<SizeClass>& sizes = {}, double top = 0);

  /// Settles the case anew, after `config` or `sizes` changed.
  void settle() { *this = SettledCase(config, sizes); }

  /// Sections that solvers take: mesh, schedule of the flow, bodies.
  const FluidCase& fluid() const { return coupled.fluid.value(); }
  const GrainsCase& grains() const { return coupled.grains.value(); }
  /// Bodies of the case; they are shared.
  const Bodies& bodies() const;

  Config config;
  std::vector<SizeClass> sizes;
  CoupledCase coupled;
  std::vector<HeapConfig> heaps;  // heaps that it pours, in their order; empty: it pours none
  Derived numbers;
};

}  // namespace barchan
