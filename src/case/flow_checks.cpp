#include "src/case/flow_checks.hpp"

#include <cmath>

#include "src/fluid/flow_schedule.hpp"

namespace barchan {
namespace {

/// Smallest number of fluid steps in a sine's period.
constexpr double kStepsOfPeriod = 10;

/// Checks an entry alone; `number` counts from 1.
void check_entry(const FlowTarget& entry, std::size_t number, const Config& c, Findings& found) {
  const bool swings = entry.amplitude != PlaneVelocity{};
  found.error_if(swings && entry.period == 0, {"fluid.schedule", "fluid.schedule.period"},
                 "must have a period above 0 in entry {}, which has an amplitude", number);
  found.error_if(!swings && entry.period > 0, {"fluid.schedule", "fluid.schedule.amplitude"},
                 "must have no period in entry {}, which has no amplitude", number);
  const double shortest = kStepsOfPeriod * c.time.fluid_step;
  found.error_if(entry.period > 0 && entry.period < shortest * (1 - 1e-9),
                 {"fluid.schedule", "fluid.schedule.period", "time.fluid_step"},
                 "must have a period of at least {:.3g} s, {} fluid steps, in entry {}", shortest,
                 kStepsOfPeriod, number);
}

/// Checks an entry against the one before it.
void check_order(const FlowTarget& before, const FlowTarget& entry, std::size_t number,
                 Findings& found) {
  if (found.error_if(entry.time <= before.time, {"fluid.schedule", "fluid.schedule.time"},
                     "must be in order of time: entry {} is at {:.6g} s, the one before at "
                     "{:.6g} s",
                     number, entry.time, before.time))
    return;
  const double until = before.time + before.ramp;
  found.error_if(until > entry.time * (1 + 1e-9),
                 {"fluid.schedule", "fluid.schedule.ramp", "fluid.schedule.time"},
                 "must end the ramp of entry {} at the time of the next, {:.6g} s; it lasts until "
                 "{:.6g} s",
                 number - 1, entry.time, until);
}

/// Entries with the same warning, of which there may be thousands.
struct Entries {
  std::size_t first = 0, count = 0;  // numbers count from 1
  void add(bool one, std::size_t number) {
    if (one && count++ == 0) first = number;
  }
  std::string words() const {
    return count > 1 ? fmt::format("entry {} and {} more", first, count - 1)
                     : fmt::format("entry {}", first);
  }
};

void warn_of_entries(const Config& c, Findings& found) {
  const std::vector<FlowTarget>& schedule = c.fluid->schedule;
  Entries late, sudden;
  for (std::size_t n = 0; n < schedule.size(); ++n) {
    const FlowTarget& entry = schedule[n];
    late.add(entry.time >= c.time.end, n + 1);
    sudden.add(n > 0 && entry.ramp == 0 && entry.velocity != schedule[n - 1].velocity, n + 1);
  }
  found.warning_if(late.count > 0, {"fluid.schedule", "time.end"},
                   "has {} at {:.6g} s, after the end of the run", late.words(),
                   late.count > 0 ? schedule[late.first - 1].time : 0);
  found.warning_if(sudden.count > 0, {"fluid.schedule", "fluid.schedule.ramp"},
                   "changes the flow in one step in {}: the pressure that does it pushes "
                   "grains as well; give it a ramp",
                   sudden.words());
}

}  // namespace

void check_schedule(const Config& c, Findings& found) {
  const FluidConfig& fluid = *c.fluid;
  const std::vector<FlowTarget>& schedule = fluid.schedule;
  if (schedule.empty()) return;
  found.error_if(fluid.mean_velocity != PlaneVelocity{}, {"fluid.schedule", "fluid.mean_velocity"},
                 "contradicts mean_velocity: give one of the two");
  found.error_if(fluid.pressure_gradient.has_value(), {"fluid.schedule", "fluid.pressure_gradient"},
                 "contradicts pressure_gradient: give one of the two");
  found.error_if(schedule.front().time != 0, {"fluid.schedule", "fluid.schedule.time"},
                 "must begin with an entry of time 0; the first is at {:.6g} s",
                 schedule.front().time);
  for (std::size_t n = 0; n < schedule.size(); ++n) {
    check_entry(schedule[n], n + 1, c, found);
    if (n > 0) check_order(schedule[n - 1], schedule[n], n + 1, found);
  }
  warn_of_entries(c, found);
}

void check_flow_at_start(const Config& c, Findings& found) {
  const FluidConfig& fluid = *c.fluid;
  const std::vector<FlowTarget> schedule = flow_schedule(fluid);
  const bool held = velocity_at_start(schedule) != PlaneVelocity{};
  const bool pushed = fluid.pressure_gradient.value_or(0) != 0;
  found.error_if(c.initial.starts_as<TurbulentFlow>() && !held && !pushed,
                 {"initial.fluid", "fluid.mean_velocity", "fluid.pressure_gradient",
                  "fluid.schedule", "fluid.schedule.velocity"},
                 "must come with a mean_velocity or pressure_gradient, which sets its log law{}",
                 schedule.empty() ? "" : "; the schedule begins at rest");
  found.error_if(
      c.initial.starts_as<UniformFlow>() && !held,
      {"initial.fluid", "fluid.mean_velocity", "fluid.schedule", "fluid.schedule.velocity"},
      "must come with a mean_velocity, which it starts at{}",
      schedule.empty() ? "" : "; the schedule begins at rest");
  found.warning_if(held && schedule.front().ramp == 0 && c.initial.starts_as<StillFlow>() &&
                       c.grains && !c.grains->frozen,
                   {"initial.fluid", "fluid.mean_velocity", "fluid.ramp_time"},
                   "accelerates within one step and throws the grains to about half of the "
                   "velocity; start from another case or \"turbulent\", or give a ramp_time");
  const PlaneVelocity first = velocity_at_start(schedule);
  const double reynolds = 2 * c.size[1] * std::hypot(first.x, first.z) / fluid.kinematic_viscosity;
  found.warning_if(reynolds > 2000 && fluid.schedule.empty() && fluid.ramp_time == 0 &&
                       c.initial.starts_as<StillFlow>() && !c.grains && c.bodies.empty() &&
                       fluid.turbulence != Turbulence::none,
                   {"initial.fluid", "fluid.mean_velocity"},
                   "begins without turbulence, which takes long to arise by itself; \"turbulent\" "
                   "begins with a log law and perturbations");
}

}  // namespace barchan
