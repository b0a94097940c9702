// A case and what follows from it, made once: a run, its estimate and its checks read it here.
#pragma once

#include <vector>

#include "src/case/config.hpp"
#include "src/case/derived.hpp"

namespace barchan {

struct SettledCase {
  SettledCase() = default;
  /// Of a `config` that has passed validate. `sizes`: of its grains, none where they are not known;
  /// `top`: their highest point [m], 0: not known.
  // NOLINTNEXTLINE(google-explicit-constructor): a case alone will do where sizes do not matter
  SettledCase(const Config& config, const std::vector<SizeClass>& sizes = {}, double top = 0);

  /// Anew, after `config` or `sizes` changed.
  void settle() { *this = SettledCase(config, sizes); }

  /// What solvers take: mesh, schedule of the flow, bodies.
  const FluidCase& fluid() const { return coupled.fluid.value(); }
  const GrainsCase& grains() const { return coupled.grains.value(); }
  /// Those of the case; they are shared.
  const Bodies& bodies() const;

  Config config;
  std::vector<SizeClass> sizes;
  CoupledCase coupled;
  std::vector<HeapConfig> heaps;  // that it pours, in their order; none: it pours none
  Derived numbers;
};

}  // namespace barchan
