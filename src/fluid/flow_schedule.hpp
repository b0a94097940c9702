// The bulk velocity that a case wants of its flow, in time.
#pragma once

#include <vector>

#include "src/fluid/fluid_case.hpp"

namespace barchan {

/// Bulk velocities that a case wants, in order of time, from t = 0 on: its schedule, or
/// mean_velocity and ramp_time as the only entry. Empty if a pressure gradient or nothing drives
/// the flow.
std::vector<FlowTarget> flow_schedule(const FluidConfig& fluid);

/// The bulk velocity of a flow that begins as its schedule wants it, the first entry's [m/s]; zero
/// of an empty one.
PlaneVelocity velocity_at_start(const std::vector<FlowTarget>& schedule);

/// The bulk velocity wanted at t >= 0 [m/s] of a flow that began with `at_start`; zero of an empty
/// schedule. From an entry's time t_e on, with U_e the velocity wanted just before,
///   U(t) = U_e + min(1, (t - t_e) / ramp) (velocity - U_e) + amplitude sin(2 pi (t - t_e) /
///   period).
PlaneVelocity wanted_velocity(const std::vector<FlowTarget>& schedule,
                              const PlaneVelocity& at_start, double t);

/// True if a schedule ever wants a flow along x, along z.
bool goes_along(const std::vector<FlowTarget>& schedule);
bool goes_across(const std::vector<FlowTarget>& schedule);

/// Largest value that `size`, a norm of velocities, has at any time.
template <class Norm>
double largest(const std::vector<FlowTarget>& schedule, const Norm& size) {
  double most = 0;
  for (const FlowTarget& entry : schedule) {
    const double here = size(entry.velocity) + size(entry.amplitude);
    if (here > most) most = here;
  }
  return most;
}

}  // namespace barchan
