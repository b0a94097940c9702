// The table of the fields of the flow. Allocation, ghosts, restart files, frames and the estimate
// of memory follow it: a new field is a member of FluidState and a line here.
#pragma once

#include "src/parallel/grid.hpp"

namespace barchan {

/// What stands behind walls and at cuts (boundary.hpp).
enum class Ghosts { none, velocity, acceleration, scalar, eddy_viscosity };

enum FluidFieldUse : unsigned {
  kInRestart = 1,  // restart files: the next step reads it
  kInFrame = 2,    // fields.h5
};

/// A field of the flow: its name in files, unit, ghosts, uses and value at rest.
struct FluidField {
  const char* name;
  const char* unit;
  Ghosts ghosts;
  unsigned uses;
  Real at_rest = 0;
};

/// Calls action(member, field) for all fields of a FluidState (or what has the same members), in
/// the order of files.
template <class State, class Action>
constexpr void for_each_fluid_field(State&& s, const Action& action) {
  using enum Ghosts;
  // clang-format off
  action(s.u,                FluidField{"u",                "m/s",   velocity,       kInRestart | kInFrame});
  action(s.rate_previous,    FluidField{"rate_previous",    "m/s^2", none,           kInRestart});
  action(s.du_dt,            FluidField{"du_dt",            "m/s^2", acceleration,   kInRestart});
  action(s.p,                FluidField{"p",                "Pa",    scalar,         kInRestart | kInFrame});
  action(s.p_previous,       FluidField{"p_previous",       "Pa",    scalar,         kInRestart});
  action(s.alpha_f,          FluidField{"alpha_f",          "1",     scalar,         kInRestart | kInFrame, 1});
  action(s.alpha_f_previous, FluidField{"alpha_f_previous", "1",     scalar,         kInRestart, 1});
  action(s.nu_t,             FluidField{"nu_t",             "m^2/s", eddy_viscosity, kInRestart | kInFrame});
  // clang-format on
}

}  // namespace barchan
