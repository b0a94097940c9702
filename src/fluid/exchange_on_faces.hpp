// What the grains do to the fluid in one step.
#pragma once

#include "src/parallel/region.hpp"

namespace barchan {

/// Where the flow meets grains.
struct FlowRegions {
  explicit FlowRegions(const Grid& grid) : exchange(grid), fraction(grid) {}
  Region exchange;        // elsewhere nothing is exchanged
  ActiveRegion fraction;  // elsewhere the fraction is one, before and after the step
};

/// On faces. Of the impulse wall faces and ghosts are not read.
struct ExchangeOnFaces {
  FaceVector impulse;  // momentum per volume given to the fluid [N s/m^3]
  Field interlayer_drag_x{},
      interlayer_drag_z{};  // of InterlayerDrag, on faces [kg/m^3]; empty: none
  Field alpha_raw{};        // share of the stress that the fluid takes; empty: its old fraction
  const FlowRegions* regions = nullptr;  // none: everywhere. Nothing is read elsewhere
};

}  // namespace barchan
