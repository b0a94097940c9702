#include "src/state_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "src/field_file.hpp"

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

/// The first n rows of a per-grain array, as a contiguous copy or window.
template <class T>
auto first_rows(const Kokkos::View<T*>& v, int n) {
  return Kokkos::subview(v, std::pair<int, int>(0, n));
}
template <class T>
auto first_rows(const Kokkos::View<T**, Kokkos::LayoutLeft>& v, int n) {
  return Kokkos::subview(v, std::pair<int, int>(0, n), Kokkos::ALL());
}

template <class F>
void for_each_grain_array(const GrainState& s, const F& f) {
  const int n = s.n;
  f("grains/id", first_rows(s.id, n));
  f("grains/kin", first_rows(s.kin, n));
  f("grains/contact_force", first_rows(s.contact_force, n));
  f("grains/contact_torque", first_rows(s.contact_torque, n));
  f("grains/x_reference", first_rows(s.x_reference, n));
  if (s.exchange.fluid_force.extent(0) > 0) {
    f("grains/u_f", first_rows(s.fluid.u_f, n));
    f("grains/fluid_force", first_rows(s.exchange.fluid_force, n));
    f("grains/carried_impulse", first_rows(s.exchange.carried_impulse, n));
  }
  f("grains/wall_xi_t", first_rows(s.wall_xi_t, n));
  if (s.wall_torque.extent(0) > 0) f("grains/wall_torque", first_rows(s.wall_torque, n));
  f("grains/wall_touching", first_rows(s.wall_touching, n));
}

/// Contact history by slot of the neighbour list.
template <class F>
void for_each_pair_array(const PairList& list, const F& f) {
  const int n = list.n_pairs;
  f("pairs/xi_t", first_rows(list.xi_t, n));
  f("pairs/touching", first_rows(list.touching, n));
  if (list.has_rolling()) f("pairs/rolling", first_rows(list.rolling, n));
}

/// Pairs stand in the order of the chunks, which are others on a GPU than on a CPU.
void check_order_of_pairs(const CheckpointReader& file, const PairList& list) {
  const std::string name = "pairs/rows_per_chunk";
  if (!file.has(name) || file.integer(name) == list.chunks.rows) return;
  throw std::runtime_error("cannot restart from " + file.path().string() +
                           ": its contacts are in the order of another kind of device; go on where "
                           "it was written, CPU or GPU");
}

}  // namespace

void save_state(CheckpointWriter& file, const SystemState& state) {
  const auto write = [&file](const std::string& name, const auto& view) { file.array(name, view); };
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
  if (state.grains) {
    const GrainState& s = *state.grains;
    for_each_grain_array(s, write);
    for_each_pair_array(s.list, write);
    file.scalar("pairs/rows_per_chunk", std::int64_t{s.list.chunks.rows});
    file.scalar("grains/r_max", s.r_max);
    file.scalar("grains/r_min", s.r_min);
    file.scalar("grains/sauter_diameter", s.sauter_diameter);
    file.scalar("grains/n_initial", s.n_initial);
    file.scalar("grains/n_left", s.n_left);
  }
}

GrainState grains_in_file(const CheckpointReader& file, Real density) {
  InitialGrains rows;
  rows.id = file.array<std::int64_t>("grains/id");
  const std::size_t n = rows.id.size();
  const auto numbers =
      file.array<double>("grains/kin", {n, sizeof(GrainKinematics) / sizeof(double)});
  rows.diameter.resize(n);
  rows.x.resize(n);
  rows.u.resize(n);
  rows.omega.resize(n);
  constexpr std::size_t width = sizeof(GrainKinematics) / sizeof(double);
  constexpr std::size_t radius_at = offsetof(GrainKinematics, r) / sizeof(double);
  for (std::size_t g = 0; g < n; ++g) rows.diameter[g] = 2 * numbers[g * width + radius_at];
  GrainState s = make_grain_state(rows, density);
  s.r_max = file.real("grains/r_max");
  s.r_min = file.real("grains/r_min");
  s.sauter_diameter = file.real("grains/sauter_diameter");
  s.n_initial = file.integer("grains/n_initial");
  s.n_left = file.integer("grains/n_left");
  return s;
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
  if (!state.grains) return;
  const auto read = [&file](const std::string& name, const auto& view) { file.array(name, view); };
  for_each_grain_array(*state.grains, read);
  step.grain_solver()->restore_list(*state.grains);
  check_order_of_pairs(file, state.grains->list);
  for_each_pair_array(state.grains->list, read);
}

}  // namespace barchan
