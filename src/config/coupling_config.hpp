// What a case says of the forces between grains and flow.
#pragma once

#include "src/config/choices.hpp"

namespace barchan {

/// coupling.forces
struct ForceSwitches {
  bool drag = true, pressure_gradient = true, stress = true, added_mass = true, buoyancy = true;
  bool lift = false, torque = false, wall_drag = false;
  bool operator==(const ForceSwitches&) const = default;
};

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
  CouplingScheme scheme = CouplingScheme::layered;
  CentredConfig centred, smoothed;
  CfdemConfig cfdem;
  double smoothing_length = 6e-4;  // [m], 0: off; in a case 3 d by default, as in the paper
  bool alpha_time_derivative = true;
  ForceSwitches forces;
  bool operator==(const CouplingConfig&) const = default;
};

}  // namespace barchan
