#include "src/output/state_file.hpp"

#include "src/output/field_file.hpp"
#include "src/output/grain_state_file.hpp"

namespace barchan {

namespace {

/// Calls f(name, field) for every field of the flow that the next step reads.
template <class F>
void for_each_field(const FluidState& s, const F& f) {
  const auto faces = [&](const std::string& name, const FaceVector& v) {
    f(name + "_x", v.x);
    f(name + "_y", v.y);
    f(name + "_z", v.z);
  };
  faces("fluid/u", s.u);
  faces("fluid/rate_previous", s.rate_previous);
  faces("fluid/du_dt", s.du_dt);
  f("fluid/p", s.p);
  f("fluid/p_previous", s.p_previous);
  f("fluid/alpha_f", s.alpha_f);
  f("fluid/alpha_f_previous", s.alpha_f_previous);
  f("fluid/nu_t", s.nu_t);
}

}  // namespace

void save_state(CheckpointWriter& file, const SystemState& state, const CoupledStep& step) {
  if (state.fluid) {
    const FluidState& s = *state.fluid;
    for_each_field(
        s, [&](const std::string& name, const Field& f) { save_field(file, name, s.grid, f); });
    file.scalar("fluid/drive", s.drive);
    file.scalar("fluid/has_history", std::int64_t{s.has_history});
    file.scalar("fluid/dt_previous", s.dt_previous);
    file.scalar("fluid/time", s.time);
    file.scalar("fluid/bulk_at_start", s.bulk_at_start);
    file.scalar("fluid/flow_missed", s.flow_missed);
  }
  if (state.grains) save_grains(file, *state.grains, step.neighbor_list());
}

void load_flow(const CheckpointReader& file, FluidState& fluid) {
  for_each_field(fluid, [&](const std::string& name, const Field& f) {
    load_field(file, name, fluid.grid, f);
  });
  fluid.drive = file.real("fluid/drive");
  fluid.has_history = file.integer("fluid/has_history") != 0;
  fluid.dt_previous = file.real("fluid/dt_previous");
  fluid.time = file.real("fluid/time");
  fluid.bulk_at_start = file.real("fluid/bulk_at_start");
  fluid.flow_missed = file.real("fluid/flow_missed");
}

void load_state(const CheckpointReader& file, SystemState& state, CoupledStep& step) {
  if (state.fluid) load_flow(file, *state.fluid);
  if (state.grains) load_grains(file, *state.grains, step.neighbor_list());
}

}  // namespace barchan
