#include "src/restart/state_file.hpp"

#include <algorithm>

#include "src/parallel/mirror.hpp"
#include "src/restart/grain_state_file.hpp"

namespace barchan {

namespace {

std::uint64_t size(int n) { return static_cast<std::uint64_t>(n); }

Extents whole_extents(const Grid& grid) {
  return {size(grid.nz_all + 2), size(grid.ny + 2), size(grid.nx_all + 2)};
}

/// Cells of one direction, ghosts counted from 0, that this rank writes: its own, and the ghosts at
/// the ends of the domain.
struct Written {
  int begin, count;
  Written(int first, int n, int n_all)
      : begin(first == 0 ? 0 : 1), count((first + n == n_all ? n + 2 : n + 1) - begin) {}
};

/// Calls f(name, field) for every field of the flow that restart files have.
template <class F>
void for_each_field(const FluidState& s, const F& f) {
  for_each_fluid_field(s, [&](const auto& member, const FluidField& field) {
    if ((field.uses & kInRestart) == 0) return;
    for_each_component(member, [&](const Field& one, const char* component) {
      f(std::string("fluid/") + field.name + component, one);
    });
  });
}

/// Calls f(name, number, whether it must be there) for the numbers of the flow that the next step
/// reads, besides has_history. Those along z are there only where they are not zero.
template <class State, class F>
void for_each_number(State&& s, const F& f) {
  f("fluid/drive", s.drive.x, true);
  f("fluid/dt_previous", s.dt_previous, true);
  f("fluid/time", s.time, true);
  f("fluid/bulk_at_start", s.bulk_at_start.x, true);
  f("fluid/flow_missed", s.flow_rate_defect.x, true);
  f("fluid/drive_z", s.drive.z, false);
  f("fluid/bulk_at_start_z", s.bulk_at_start.z, false);
  f("fluid/flow_missed_z", s.flow_rate_defect.z, false);
}

}  // namespace

void save_field(CheckpointWriter& file, const std::string& name, const Grid& grid, const Field& f) {
  if (!grid.ranks || f.origin == nullptr) {
    file.array(name, f.storage);
    return;
  }
  const auto host = host_copy(f.storage);
  const Written x(grid.i_begin, grid.nx, grid.nx_all), z(grid.k_begin, grid.nz, grid.nz_all);
  std::vector<double> values;
  values.reserve(size(x.count) * size(grid.ny + 2) * size(z.count));
  for (int k = z.begin; k < z.begin + z.count; ++k)
    for (int j = 0; j < grid.ny + 2; ++j)
      for (int i = x.begin; i < x.begin + x.count; ++i) values.push_back(host(i, j, k));
  file.array(name, std::span<const double>(values),
             {size(z.count), size(grid.ny + 2), size(x.count)},
             {.whole = whole_extents(grid),
              .first = {size(grid.k_begin + z.begin), 0, size(grid.i_begin + x.begin)}});
}

void load_field(const CheckpointReader& file, const std::string& name, const Grid& grid,
                const Field& f) {
  if (!grid.ranks || f.origin == nullptr) {
    file.array(name, f.storage);
    return;
  }
  const std::vector<double> values =
      file.array<double>(name, whole_extents(grid), {size(grid.k_begin), 0, size(grid.i_begin)},
                         {size(grid.nz + 2), size(grid.ny + 2), size(grid.nx + 2)});
  const auto host = mirror(f.storage);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(f.storage, host);
}

void save_state(CheckpointWriter& file, const SystemState& state, const NeighborList* list) {
  if (state.fluid) {
    const FluidState& s = *state.fluid;
    for_each_field(
        s, [&](const std::string& name, const Field& f) { save_field(file, name, s.grid, f); });
    for_each_number(s, [&](const char* name, Real number, bool always) {
      if (always || number != 0) file.scalar(name, number);
    });
    file.scalar("fluid/has_history", std::int64_t{s.has_history});
  }
  if (state.grains) save_grains(file, *state.grains, *list);
}

void load_flow(const CheckpointReader& file, FluidState& fluid) {
  for_each_field(fluid, [&](const std::string& name, const Field& f) {
    load_field(file, name, fluid.grid, f);
  });
  for_each_number(fluid, [&](const char* name, Real& number, bool always) {
    number = always || file.has(name) ? file.real(name) : 0;
  });
  fluid.has_history = file.integer("fluid/has_history") != 0;
}

void load_state(const CheckpointReader& file, SystemState& state, NeighborList* list) {
  if (state.fluid) load_flow(file, *state.fluid);
  if (state.grains) load_grains(file, *state.grains, *list);
}

}  // namespace barchan
