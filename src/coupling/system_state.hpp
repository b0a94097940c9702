// What a run is made of.
#pragma once

#include <optional>

#include "src/fluid/fluid_state.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// Either part may be missing.
struct SystemState {
  std::optional<FluidState> fluid;
  std::optional<GrainState> grains;
};

}  // namespace barchan
