// The table of the fields of the flow. Allocation, ghosts, restart files, frames and the estimate
// of memory follow it: a new field is a member of FluidState and a line here.
#pragma once

#include "src/parallel/grid.hpp"

namespace barchan {

/// Ghosts of a field behind walls and at cuts (boundary.hpp).
enum class Ghosts { none, velocity, acceleration, scalar, eddy_viscosity };

enum FluidFieldUse : unsigned {
  kInRestart = 1,  // restart files: the next step reads it
  kInFrame = 2,    // fields.h5
};

/// A field of the flow: its name in files, unit, meaning, ghosts, uses and value at rest.
struct FluidField {
  const char *name, *unit, *meaning;
  Ghosts ghosts;
  unsigned uses;
  Real at_rest = 0;
};

/// Calls action(member, field) for all fields of a FluidState (or what has the same members), in
/// the order of files.
template <class State, class Action>
constexpr void for_each_fluid_field(State&& s, const Action& action) {
  using enum Ghosts;
  using F = FluidField;
  constexpr unsigned in_both = kInRestart | kInFrame;
  action(s.u, F{"u", "m/s", "velocity", velocity, in_both});
  action(s.rate_previous, F{"rate_previous", "m/s^2", "rate of u a step ago", none, kInRestart});
  action(s.du_dt, F{"du_dt", "m/s^2", "change of u in the last step", acceleration, kInRestart});
  action(s.p, F{"p", "Pa", "pressure without its hydrostatic and driving parts", scalar, in_both});
  action(s.p_previous, F{"p_previous", "Pa", "p a step ago", scalar, kInRestart});
  action(s.alpha_f, F{"alpha_f", "1", "volume fraction of the fluid", scalar, in_both, 1});
  action(s.alpha_f_previous,
         F{"alpha_f_previous", "1", "alpha_f before the last deposit", scalar, kInRestart, 1});
  action(s.nu_t, F{"nu_t", "m^2/s", "subgrid viscosity", eddy_viscosity, in_both});
}

}  // namespace barchan
