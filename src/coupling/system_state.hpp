// State of a run.
#pragma once

#include <optional>

#include "src/fluid/fluid_state.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// State of flow and grains; either part may be missing.
struct SystemState {
  std::optional<FluidState> fluid;
  std::optional<GrainState> grains;
};

}  // namespace barchan
