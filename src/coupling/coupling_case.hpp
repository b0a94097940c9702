// Keys of a case about the forces between grains and flow.
#pragma once

#include "kernels/coupling/shape_drag.hpp"
#include "src/base/time_case.hpp"
#include "src/fluid/fluid_case.hpp"
#include "src/grains/grains_case.hpp"

namespace barchan {

using DragLaw = Choice<DragLaws>;
using ShapeDragLaw = Choice<ShapeDragLaws>;
enum class VoidFraction { divided, centre };
enum class CouplingScheme { layered, centred, smoothed, cfdem, resolved };

/// [coupling.centred], [coupling.smoothed]
struct CentredConfig {
  VoidFraction void_fraction = VoidFraction::divided;
  bool operator==(const CentredConfig&) const = default;
};

/// [coupling.cfdem]
struct CfdemConfig {
  bool smooth_exchange = false;
  bool operator==(const CfdemConfig&) const = default;
};

/// [coupling]
struct CouplingConfig {
  DragLaw drag = DragLaw::of<Gidaspow>();
  ShapeDragLaw shape_drag = ShapeDragLaw::of<HoelzerSommerfeld>();
  CouplingScheme scheme = CouplingScheme::layered;
  CentredConfig centred, smoothed;
  CfdemConfig cfdem;
  double smoothing_length = 6e-4;  // [m], 0: off; in a case 3 d by default, as in the paper
  bool alpha_time_derivative = true;
  ForceSwitches forces;
  bool operator==(const CouplingConfig&) const = default;
};

/// Tells if grains move in a flow that is resolved around them.
inline bool is_immersed(const CouplingConfig& coupling, const GrainConfig& grains) {
  return coupling.scheme == CouplingScheme::resolved && !grains.frozen;
}

/// Input of the coupled step, settled once.
struct CoupledCase {
  CouplingConfig coupling;
  TimeConfig time;
  std::optional<FluidCase> fluid;
  std::optional<GrainsCase> grains;
};

}  // namespace barchan
