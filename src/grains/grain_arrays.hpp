// Table of all arrays that a grain has, for code that allocates, sorts, moves, copies or saves
// them.
#pragma once

#include "src/grains/grain_state.hpp"
#include "src/parallel/pack.hpp"

namespace barchan {

/// Calls action(GrainArray, array) for each array of a grain, in the order of restart files. A new
/// array of a grain is a member of GrainState and a line here.
template <class State, class Action>
void for_each_grain_array(State& s, const Action& action) {
  using enum Allocated;
  auto& f = s.fluid;
  auto& e = s.exchange;
  const auto add = [&](auto& array, const char* name, const char* unit, Allocated allocated,
                       unsigned uses = 0) {
    action(GrainArray{name, unit, allocated, uses}, array);
  };
  const unsigned of_moving = f.is_resolved ? unsigned{kRestart} : 0u;  // frozen: not read
  // clang-format off
  add(s.id,               "id",               "1",    always,     kRestart | kGhosts);
  add(s.kin,              "kin",              "SI",   always,     kRestart | kGhosts | kGatherReads |
                                                               kDepositReads);
  add(s.kind,             "kind",             "1",    by_solver,  kRestart | kGhosts);
  add(s.heap,             "heap",             "1",    by_solver,  kRestart);
  add(s.clump,            "clump",            "SI",   by_solver,  kRestart);
  add(f.part,             "part",             "1",    by_solver,  kGatherReads);
  add(s.contact_force,    "contact_force",    "N",    always,     kRestart);
  add(s.contact_torque,   "contact_torque",   "N m",  always,     kRestart);
  add(s.x_reference,      "x_reference",      "m",    always,     kRestart);
  add(f.impulse,          "impulse",          "N s",  with_fluid, kRestartWithFlow | kGatherReads |
                                                               kDepositReads);
  add(s.wall_xi_t,        "wall_xi_t",        "m",    by_solver,  kRestart);
  add(s.wall_torque,      "wall_torque",      "N m",  by_solver,  kRestart);
  add(s.wall_touching,    "wall_touching",    "1",    always,     kRestart);
  add(s.body_xi_t,        "body_xi_t",        "m",    by_solver,  kRestart);
  add(s.body_torque,      "body_torque",      "N m",  by_solver,  kRestart);
  add(s.body_touching,    "body_touching",    "1",    by_solver,  kRestart);
  add(f.u_f,              "u_f",              "m/s",  with_fluid, kGatherWrites);
  add(f.acceleration,     "acceleration",     "m/s2", with_fluid, kGatherWrites | of_moving);
  add(f.inv_fluid_mass,   "inv_fluid_mass",   "1/kg", with_fluid, kGatherWrites | kDepositReads);
  add(f.beta,             "beta",             "kg/s", with_fluid, kGatherWrites | kDepositReads);
  add(f.explicit_force,   "explicit_force",   "N",    always,     kGatherWrites);
  add(f.added_mass,       "added_mass",       "kg",   with_fluid, kGatherWrites);
  add(f.u_start,          "u_start",          "m/s",  with_fluid);
  add(e.pressure_force,   "pressure_force",   "N",    with_flow,  kGatherWrites);
  add(e.stress_force,     "stress_force",     "N",    with_flow,  kGatherWrites);
  add(e.added_mass_force, "added_mass_force", "N",    with_flow,  kGatherWrites | kDepositReads);
  add(e.lift,             "lift",             "N",    with_lift,  kGatherWrites | kDepositReads);
  add(e.resolved_force,   "resolved_force",   "N",    when_resolved, of_moving);
  add(e.resolved_torque,  "resolved_torque",  "N m",  when_resolved, of_moving);
  add(e.inner_momentum,   "inner_momentum",   "N s",  when_immersed, kRestart);
  add(e.inner_spin,       "inner_spin",       "N m s", when_immersed, kRestart);
  add(f.spin_acceleration, "spin_acceleration", "rad/s2", when_immersed, kRestart);
  add(f.spin_start,       "spin_start",       "rad/s", when_immersed);
  add(f.explicit_torque,  "explicit_torque",  "N m",  when_immersed);
  add(f.omega_f,          "omega_f",          "rad/s", with_torque, kGatherWrites);
  add(f.beta_r,           "beta_r",           "N m s", with_torque, kGatherWrites);
  // clang-format on
  for (auto& x : s.extra) add(x.values, x.name.c_str(), x.unit.c_str(), always, x.uses);
}

/// Calls action(GrainArray, array) for each allocated array with one of these uses.
template <class State, class Action>
void for_each_grain_array(State& s, unsigned uses, const Action& action) {
  for_each_grain_array(s, [&](const GrainArray& about, auto& array) {
    if (array.size() > 0 && ((about.uses & uses) != 0 || uses == kAnyUse)) action(about, array);
  });
}

/// Layout of the values of a grain that are packed together for these uses.
inline PackLayout layout_of(const GrainState& s, unsigned uses = kAnyUse) {
  PackLayout layout;
  for_each_grain_array(s, uses, [&](const auto&, const auto& array) { layout.add(array); });
  return layout;
}

/// Makes room for n entries of one array, an eighth more where it grows; its content stays.
template <class View>
void reserve_entries(View& array, int n) {
  const auto entries = static_cast<std::size_t>(n);
  if (array.extent(0) >= entries) return;
  const std::size_t room = entries + entries / 8;
  if constexpr (View::rank() == 2) {
    Kokkos::resize(array, room, array.extent(1));
  } else {
    Kokkos::resize(array, room);
  }
}

}  // namespace barchan
