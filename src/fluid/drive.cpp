#include "src/fluid/drive.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "src/base/errors.hpp"
#include "src/fluid/flow_schedule.hpp"

namespace barchan {

Drive::Drive(const FluidConfig& config, std::vector<FlowTarget> schedule)
    : gradient_x_(config.pressure_gradient.value_or(0) / config.density),
      schedule_(std::move(schedule)),
      along_z_(goes_across(schedule_)),
      small_(1e-3 *
             largest(schedule_, [](const PlaneVelocity& u) { return std::hypot(u.x, u.z); })) {}

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

void Drive::check(Real t, const Vec2& wanted, const Vec2& bulk) {
  constexpr int kPatience = 20;
  const Real off = std::hypot(bulk.x - wanted.x, bulk.z - wanted.z);
  const Real speed = std::hypot(wanted.x, wanted.z), missed = speed > 0 ? off / speed : 0;
  const bool in_vain = off > small_ && missed > 0.5 && missed > 0.99 * missed_;
  in_vain_ = in_vain ? in_vain_ + 1 : 0;
  missed_ = missed;
  if (in_vain_ < kPatience) return;
  throw StateError(
      fmt::format(
          "t = {:.6g} s: the flow has a bulk velocity of ({:.3g}, {:.3g}) m/s along x and z, "
          "({:.3g}, {:.3g}) m/s is wanted, and for {} steps no force has brought it nearer: "
          "something closes the channel; look at [[body]], fluid.cells and the grains",
          t, bulk.x, bulk.z, wanted.x, wanted.z, kPatience),
      true);
}

}  // namespace barchan
