// Exchange of the fluid with grains in one step.
#pragma once

#include "src/parallel/region.hpp"

namespace barchan {

/// Where the flow meets grains.
struct FlowRegions {
  explicit FlowRegions(const Grid& grid) : exchange(grid), fraction(grid) {}
  Region exchange;        // elsewhere nothing is exchanged
  ActiveRegion fraction;  // elsewhere the fraction is one, before and after the step
};

/// Exchange on faces. The impulse is not read on walls and in ghosts.
struct ExchangeOnFaces {
  FaceVector impulse;         // momentum per volume given to the fluid [N s/m^3]
  Field interlayer_drag_x{};  // coefficients of InterlayerDrag [kg/m^3]; empty: none
  Field interlayer_drag_z{};
  Field
      alpha_raw{};  // raw fluid fraction, by which the fluid shares the stress; empty: its old one
  const FlowRegions* regions = nullptr;  // where anything is read; null: everywhere
};

}  // namespace barchan
