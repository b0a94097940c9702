#include "src/fluid/drive.hpp"

#include <algorithm>
#include <utility>

namespace barchan {

Drive::Drive(const FluidConfig& config)
    : velocity_x_(config.mean_velocity.x), ramp_time_(config.ramp_time) {
  if (config.pressure_gradient) {
    kind_ = Kind::gradient;
    force_x_ = *config.pressure_gradient / config.density;
  } else if (config.mean_velocity != PlaneVelocity{}) {
    kind_ = Kind::velocity;
  }
}

Drive::Drive(std::vector<Target> schedule)
    : kind_(schedule.empty() ? Kind::none : Kind::schedule),
      schedule_(std::move(schedule)),
      along_z_(
          std::ranges::any_of(schedule_, [](const Target& at) { return at.velocity.z != 0; })) {}

Vec2 Drive::target(Real t, const Vec2& at_start) const {
  if (kind_ == Kind::velocity) {
    const Real share = ramp_time_ > 0 ? std::min(Real(1), t / ramp_time_) : Real(1);
    return {at_start.x + share * (velocity_x_ - at_start.x), 0};
  }
  if (kind_ != Kind::schedule) return {};
  const auto next = std::ranges::find_if(schedule_, [&](const Target& at) { return at.t > t; });
  if (next == schedule_.begin()) return next->velocity;
  if (next == schedule_.end()) return schedule_.back().velocity;
  const auto& [t_0, from] = *(next - 1);
  const auto& [t_1, to] = *next;
  const Real share = (t - t_0) / (t_1 - t_0);
  return {from.x + share * (to.x - from.x), from.z + share * (to.z - from.z)};
}

Vec2 Drive::force(const FluidState& fluid, const DrivenFlow& flow, Real dt) const {
  if (kind_ == Kind::none) return {};
  if (kind_ == Kind::gradient) return {force_x_, 0};
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
