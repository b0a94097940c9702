// Grains placed one by one in a box of fluid, coupled or with the fluid held still.
#pragma once

#include <array>
#include <utility>

#include "src/case/config.hpp"
#include "src/coupling/coupled_step.hpp"
#include "src/coupling/grain_forces.hpp"
#include "src/fluid/domain.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/grain_cases.hpp"

namespace barchan::test {

/// Laminar flow in a box with free-slip walls, periodic in x and z, for grains as well; no gravity
/// and no smoothing. Grain material soft enough for long steps; contacts are not the subject.
inline Config water_box(std::array<int, 3> cells, std::array<double, 3> size) {
  Config c = flow_config(cells, size, 0);
  c.title = "water box";
  c.output.grain_forces = true;
  c.fluid->turbulence = Turbulence::none;
  c.fluid->bottom = c.fluid->top = WallFlow::free_slip;
  c.coupling.smoothing_length = 0;
  c.grains.emplace();
  c.grains->gravity = {0, 0, 0};
  c.grains->material.youngs_modulus = c.grains->wall.youngs_modulus = 5e4;
  c.grains->boundary_x = GrainBoundaryX::periodic;
  c.time.fluid_step = 2.5e-4;
  c.time.grain_step = 2.5e-5;
  return c;
}

/// Box without a flow solver: grains in still, unbounded fluid.
inline Config still_water(std::array<double, 3> size) {
  Config c = water_box({1, 1, 1}, size);
  c.fluid.reset();
  c.grains->ambient.emplace();
  return c;
}

/// Force or torque on every grain, by its name in grains.h5.
struct NamedForce {
  std::string name;
  Kokkos::View<const Vec3*> values;
};

/// Forces that the run has.
inline std::vector<NamedForce> named(const ForceArrays& f) {
  std::vector<NamedForce> all{{"force_flow", f.flow},
                              {"torque_flow", f.torque},
                              {"force_drag", f.drag},
                              {"force_added_mass", f.added_mass},
                              {"force_lift", f.lift},
                              {"force_pressure_gradient", f.pressure_gradient},
                              {"force_stress", f.stress},
                              {"force_contact_normal", f.contact_normal},
                              {"force_contact_tangential", f.contact_tangential},
                              {"force_total", f.total}};
  std::erase_if(all, [](const NamedForce& one) { return one.values.size() == 0; });
  return all;
}

/// Run that is stepped by hand; with grains alone the fluid is at rest.
struct CoupledRun {
  Config config;
  SystemState state;
  CoupledStep step;

  CoupledRun(const Config& c, SystemState from)
      : config(c), state(std::move(from)), step(config, state) {
    step.start(state);
  }
  CoupledRun(const Config& c, const InitialGrains& grains) : CoupledRun(c, make_state(c, grains)) {}
  void advance(int n = 1) {
    for (int s = 0; s < n; ++s) step.advance(state);
  }
  std::vector<test::GrainRow> rows() const { return test::rows_by_id(*state.grains); }
  /// Fills the ghosts after the flow was set by hand.
  void fill_ghosts() { step.fluid_solver()->fill_ghosts(*state.fluid); }
  /// Forces on the grains in the last step.
  std::vector<NamedForce> forces() const {
    return named(grain_forces(state, *step.grain_solver(), step.dt()));
  }
  Vec3 velocity_of(int id) const { return rows()[static_cast<std::size_t>(id)].u; }

 private:
  static SystemState make_state(const Config& c, const InitialGrains& grains) {
    SystemState made;
    made.grains = make_grain_state(grains, c.grains->density);
    if (c.fluid) made.fluid = make_fluid_state(make_grid(c));
    return made;
  }
};

/// Grains as they lie after `steps` in a fluid that is not computed.
inline InitialGrains settled(Config c, const InitialGrains& loose, int steps) {
  c.fluid.reset();
  c.grains->ambient.emplace();
  CoupledRun pour(c, loose);
  pour.advance(steps);
  InitialGrains grains;
  const auto kin = host_copy(pour.state.grains->kin);
  for (int g = 0; g < pour.state.grains->n; ++g) test::add_grain(grains, 2 * kin(g).r, kin(g).x);
  return grains;
}

/// A named force on the grain in row 0 of the last step [N].
inline Vec3 force_on_first(CoupledRun& run, const std::string& name) {
  for (const NamedForce& f : run.forces()) {
    if (f.name == name) return host_copy(f.values)(0);
  }
  return {NAN, NAN, NAN};
}

/// Mean of a cell field over cells i0 <= i < i1, all rows, all k.
inline double mean_of_columns(const Field& field, const Grid& grid, int i0, int i1) {
  const HostField f = to_host(field);
  double sum = 0;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = i0; i < i1; ++i) sum += f(i, j, k);
  return sum / ((i1 - i0) * grid.ny * grid.nz);
}

}  // namespace barchan::test
