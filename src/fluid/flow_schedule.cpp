#include "src/fluid/flow_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace barchan {
namespace {

/// Bulk velocity that `entry` wants at t from a flow that had `from` when the entry began.
PlaneVelocity wanted_by(const FlowTarget& entry, const PlaneVelocity& from, double t) {
  const double since = t - entry.time;
  const double share = entry.ramp > 0 ? std::min(1.0, since / entry.ramp) : 1;
  const PlaneVelocity mean{from.x + share * (entry.velocity.x - from.x),
                           from.z + share * (entry.velocity.z - from.z)};
  if (entry.period == 0) return mean;
  const double sine = std::sin(2 * std::numbers::pi * since / entry.period);
  return {mean.x + entry.amplitude.x * sine, mean.z + entry.amplitude.z * sine};
}

}  // namespace

std::vector<FlowTarget> flow_schedule(const FluidConfig& fluid) {
  if (!fluid.schedule.empty()) return fluid.schedule;
  if (fluid.pressure_gradient || fluid.mean_velocity == PlaneVelocity{}) return {};
  return {{.velocity = fluid.mean_velocity, .ramp = fluid.ramp_time}};
}

PlaneVelocity velocity_at_start(const std::vector<FlowTarget>& schedule) {
  return schedule.empty() ? PlaneVelocity{} : schedule.front().velocity;
}

PlaneVelocity wanted_velocity(const std::vector<FlowTarget>& schedule,
                              const PlaneVelocity& at_start, double t) {
  PlaneVelocity wanted = schedule.empty() ? PlaneVelocity{} : at_start;
  for (auto entry = schedule.begin(); entry != schedule.end() && entry->time <= t; ++entry) {
    const auto next = entry + 1;
    wanted = wanted_by(*entry, wanted, next == schedule.end() ? t : std::min(t, next->time));
  }
  return wanted;
}

bool goes_along(const std::vector<FlowTarget>& schedule) {
  return std::ranges::any_of(schedule, [](const FlowTarget& entry) {
    return entry.velocity.x != 0 || entry.amplitude.x != 0;
  });
}

bool goes_across(const std::vector<FlowTarget>& schedule) {
  return std::ranges::any_of(schedule, [](const FlowTarget& entry) {
    return entry.velocity.z != 0 || entry.amplitude.z != 0;
  });
}

}  // namespace barchan
