#include "src/fluid/drive.hpp"

#include "src/config/flow_schedule.hpp"

namespace barchan {

Drive::Drive(const FluidConfig& config)
    : gradient_x_(config.pressure_gradient.value_or(0) / config.density),
      schedule_(flow_schedule(config)),
      along_z_(goes_across(schedule_)) {}

Vec2 Drive::target(Real t, const Vec2& at_start) const {
  const auto [x, z] = wanted_velocity(schedule_, {at_start.x, at_start.z}, t);
  return {x, z};
}

Vec2 Drive::force(const FluidState& fluid, const DrivenFlow& flow, Real dt) const {
  if (schedule_.empty()) return {gradient_x_, 0};
  const Vec2 bulk = target(fluid.time, fluid.bulk_at_start);
  // The pressure in a bed takes back part of what the drive gives. How much is known only after
  // the projection, so what was missed at the last step is added.
  const auto needed = [&](Real wanted, Real missed, Real rate, Real response) {
    return (wanted * flow.height + missed - rate) / (response * dt);
  };
  return {needed(bulk.x, fluid.flow_rate_defect.x, flow.rate.x, flow.response.x),
          along_z_ ? needed(bulk.z, fluid.flow_rate_defect.z, flow.rate.z, flow.response.z) : 0};
}

}  // namespace barchan
