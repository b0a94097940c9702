// Flows to start from that are not in a file.
#pragma once

#include "kernels/math/alternatives.hpp"

namespace barchan {

struct StillFlow {
  static constexpr Named named{"still", "at rest"};
};
struct UniformFlow {
  static constexpr Named named{"uniform", "at the bulk velocity everywhere"};
};
/// Draws random numbers, which differ between realisations.
struct TurbulentFlow {
  static constexpr Named named{"turbulent", "a log law with perturbations"};
};

using StartFlows = Alternatives<StillFlow, UniformFlow, TurbulentFlow>;

}  // namespace barchan
