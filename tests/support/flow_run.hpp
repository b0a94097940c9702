// A flow that is stepped by hand.
#pragma once

#include "src/case/config.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan::test {

struct FlowRun {
  Config config;
  Grid grid;
  HostGrid h;
  FluidState fluid;
  FluidSolver solver;
  FluidStepReport report;  // of the last step

  explicit FlowRun(const Config& c)
      : FlowRun(c, c.grains ? Fraction::variable : Fraction::uniform) {}
  FlowRun(const Config& c, Fraction fraction)
      : config(c),
        grid(make_grid(c)),
        h(grid),
        fluid(make_fluid_state(grid)),
        solver(config, grid, fraction) {}

  /// The velocity along x in the owned cells, and all ghosts.
  template <class Value>
  void start(const Value& u_x) {
    set_field(fluid.u.x, grid, u_x);
    solver.fill_ghosts(fluid);
  }
  void start_uniform(double u_x) {
    start([=](int, int, int) { return u_x; });
  }
  /// A component of the velocity becomes value(j) in the first columns: what a periodic box lacks
  /// of an inlet. Ghosts are not filled.
  template <class Value>
  void hold(Field& component, int columns, const Value& value) {
    const auto now = to_host(component);
    set_field(component, grid,
              [&](int i, int j, int k) { return i < columns ? value(j) : now(i, j, k); });
  }
  const FluidStepReport& advance(double dt, const ExchangeOnFaces* exchange = nullptr) {
    return report = solver.advance(fluid, exchange, dt);
  }
  /// `steps` equal steps over `time` [s].
  void advance_over(double time, int steps) {
    for (int s = 0; s < steps; ++s) advance(time / steps);
  }
};

/// Case without a turbulence model, solved nearly to round-off; the floor holds the fluid, the top
/// is a plane of symmetry.
inline Config laminar(std::array<int, 3> cells, std::array<double, 3> size, double viscosity,
                      double tolerance = 1e-12) {
  Config config = flow_config(cells, size, 0);
  config.fluid->turbulence = Turbulence::none;
  config.fluid->kinematic_viscosity = viscosity;
  config.solver.pressure_tolerance = tolerance;
  config.solver.max_iterations = 500;
  return config;
}

/// A vortex or wave between walls of free slip, which are planes of symmetry, without a model.
inline Config smooth_flow_config(std::array<int, 3> n, std::array<double, 3> size, double first,
                                 double viscosity) {
  Config config = flow_config(n, size, first);
  config.fluid->kinematic_viscosity = viscosity;
  config.fluid->turbulence = Turbulence::none;
  config.fluid->bottom = config.fluid->top = WallFlow::free_slip;
  return config;
}

}  // namespace barchan::test
