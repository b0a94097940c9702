// Flows with a known answer.
#include <gtest/gtest.h>

#include <numbers>

#include "kernels/fluid/flow_sums.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/fluid/initial_flow.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

using std::numbers::pi;
using test::HostGrid;

/// The Taylor-Green vortex in the plane of two axes; free-slip walls in y are planes of symmetry.
struct Vortex {
  char a, b;  // u along a is sin(a) cos(b), along b it is -cos(a) sin(b)
  double phase(char axis, double x, double y, double z) const {
    return axis == 'x' ? x : axis == 'y' ? y : z;
  }
  double component(char axis, double x, double y, double z) const {
    const double s = phase(a, x, y, z), t = phase(b, x, y, z);
    if (axis == a) return std::sin(s) * std::cos(t);
    if (axis == b) return -std::cos(s) * std::sin(t);
    return 0;
  }
};

/// RMS error of the velocity after t = 0.4 on n cells per vortex length 2 pi, nu = 0.05.
double vortex_error(const Vortex& vortex, int n) {
  const auto cells = [&](char axis) {
    if (axis != vortex.a && axis != vortex.b) return 3;
    return axis == 'y' ? n / 2 : n;
  };
  Config config = test::flow_config({cells('x'), cells('y'), cells('z')}, {2 * pi, pi, 2 * pi}, 0);
  config.fluid->kinematic_viscosity = 0.05;
  config.fluid->turbulence = Turbulence::none;
  config.fluid->bottom = config.fluid->top = WallFlow::free_slip;
  const Grid grid = make_grid(config);
  const HostGrid h(grid);
  FluidState fluid = make_fluid_state(grid);
  const auto x_value = [&](int i, int j, int k) {
    return vortex.component('x', h.x_face(i), h.y(j), h.z(k));
  };
  const auto y_value = [&](int i, int j, int k) {
    return vortex.component('y', h.x(i), h.y_face(j), h.z(k));
  };
  const auto z_value = [&](int i, int j, int k) {
    return vortex.component('z', h.x(i), h.y(j), h.z_face(k));
  };
  test::set_field(fluid.u.x, grid, x_value);
  test::set_field(fluid.u.y, grid, y_value);
  test::set_field(fluid.u.z, grid, z_value);
  FluidSolver solver(config, grid);
  solver.fill_ghosts(fluid);
  const int steps = 2 * n;
  for (int s = 0; s < steps; ++s) solver.advance(fluid, nullptr, 0.4 / steps);

  const double decay = std::exp(-2 * 0.05 * 0.4);
  const auto u = test::to_host(fluid.u.x), v = test::to_host(fluid.u.y),
             w = test::to_host(fluid.u.z);
  double sum = 0;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        sum += std::pow(u(i, j, k) - decay * x_value(i, j, k), 2) +
               std::pow(v(i, j, k) - decay * y_value(i, j, k), 2) +
               std::pow(w(i, j, k) - decay * z_value(i, j, k), 2);
      }
  return std::sqrt(sum / (grid.nx * grid.ny * grid.nz));
}

TEST(FluidFlow, TaylorGreenVortexIsSecondOrderInEveryPlane) {
  for (const Vortex vortex : {Vortex{'x', 'y'}, Vortex{'y', 'z'}, Vortex{'z', 'x'}}) {
    const double coarse = vortex_error(vortex, 16), fine = vortex_error(vortex, 32);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << vortex.a << vortex.b << " " << fine;
    EXPECT_LT(fine, 2e-3);
  }
}

TEST(FluidFlow, LaminarHalfChannelNeedsTheKnownDrive) {
  const double depth = 0.02, nu = 1e-5, bulk = 0.1;
  Config config = test::flow_config({2, 12, 1}, {0.01, depth, 0.01}, 1.2e-3);
  config.fluid->kinematic_viscosity = nu;
  config.fluid->mean_velocity = bulk;
  const Grid grid = make_grid(config);
  const HostGrid h(grid);
  FluidState fluid = make_fluid_state(grid);
  test::set_field(fluid.u.x, grid, [&](int, int, int) { return bulk; });
  FluidSolver solver(config, grid);
  solver.fill_ghosts(fluid);
  FluidStepReport report;
  const double dt = 2.5e-2;  // viscous number 4 nu dt / dy^2 = 0.7
  for (int s = static_cast<int>(1.5 * depth * depth / nu / dt); s >= 0; --s)
    report = solver.advance(fluid, nullptr, dt);

  const double drive = 3 * nu * bulk / (depth * depth);
  EXPECT_NEAR(report.drive, drive, 4e-3 * drive);
  EXPECT_NEAR(solver.friction_velocity(fluid), std::sqrt(drive * depth),
              2e-3 * std::sqrt(drive * depth));
  EXPECT_NEAR(solver.bulk_velocity(fluid), bulk, 1e-14);
  const auto u = test::to_host(fluid.u.x);
  for (int j = 0; j < grid.ny; ++j) {
    const double exact = drive / (2 * nu) * h.y(j) * (2 * depth - h.y(j));
    EXPECT_NEAR(u(0, j, 0), exact, 4e-3 * bulk);
  }
}

TEST(FluidFlow, RampBringsTheBulkVelocityUp) {
  Config config = test::flow_config({4, 6, 3}, {0.01, 0.02, 0.01}, 0);
  config.fluid->mean_velocity = 0.2;
  config.fluid->ramp_time = 0.01;
  const Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid);
  FluidSolver solver(config, grid);
  for (int s = 0; s <= 5; ++s) solver.advance(fluid, nullptr, 1e-3);
  EXPECT_NEAR(solver.bulk_velocity(fluid), 0.1, 1e-13);
  for (int s = 0; s <= 10; ++s) solver.advance(fluid, nullptr, 1e-3);
  EXPECT_NEAR(solver.bulk_velocity(fluid), 0.2, 1e-13);
}

ExchangeOnFaces no_exchange(const Grid& grid) {
  return {test::make_faces(grid), test::make_faces(grid)};
}

TEST(FluidFlow, ExchangeIsTakenUpByAUniformMixture) {
  Config config = test::flow_config({4, 6, 3}, {0.01, 0.02, 0.01}, 0);
  config.fluid->bottom = WallFlow::free_slip;
  const Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid);
  const auto uniform = [](double value) { return [=](int, int, int) { return value; }; };
  const double alpha = 0.6, u = 0.3, rho = 1000, implicit = 1500, impulse = -20;
  test::set_field(fluid.alpha_f, grid, uniform(alpha));
  test::set_field(fluid.alpha_f_previous, grid, uniform(alpha));
  test::set_field(fluid.u.x, grid, uniform(u));
  ExchangeOnFaces exchange = no_exchange(grid);
  test::set_field(exchange.impulse.x, grid, uniform(impulse));
  test::set_field(exchange.implicit.x, grid, uniform(implicit));
  FluidSolver solver(config, grid);
  solver.fill_ghosts(fluid);
  solver.advance(fluid, &exchange, 1e-3);
  EXPECT_NEAR(test::to_host(fluid.u.x)(1, 2, 1), u + impulse / rho / (alpha + implicit / rho),
              1e-14);
}

TEST(FluidFlow, MovingSolidFractionConservesMass) {
  Config config = test::flow_config({16, 8, 12}, {0.04, 0.025, 0.03}, 1e-3);
  config.fluid->mean_velocity = 0.28;
  const Grid grid = make_grid(config);
  const HostGrid h(grid);
  FluidState fluid = make_fluid_state(grid);
  FluidSolver solver(config, grid);
  const ExchangeOnFaces exchange = no_exchange(grid);
  const double dt = 5e-4;
  const auto set_alpha = [&](const Field& alpha, double t) {
    test::set_field(alpha, grid, [&](int i, int j, int k) {
      const double wave = std::sin(2 * pi * (h.x(i) - 0.1 * t) / 0.04) *
                          std::cos(2 * pi * (h.z(k) + 0.05 * t) / 0.03);
      return 0.7 + 0.25 * wave * std::cos(pi * h.y(j) / 0.025);
    });
  };
  set_alpha(fluid.alpha_f_previous, 0);
  set_alpha(fluid.alpha_f, 0);
  test::set_field(fluid.u.x, grid, [](int, int, int) { return 0.28; });
  solver.fill_ghosts(fluid);
  for (int s = 1; s <= 10; ++s) {
    set_alpha(fluid.alpha_f_previous, (s - 1) * dt);
    set_alpha(fluid.alpha_f, s * dt);
    const FluidStepReport report = solver.advance(fluid, &exchange, dt);
    EXPECT_LT(report.continuity_residual, 1e-6);
    // The drive learns in two steps what the projection takes of it.
    EXPECT_NEAR(report.bulk_velocity / 0.28, 1, s <= 2 ? 0.005 : 1e-4) << s;
  }
}

/// A new solver that goes on from a state must not notice: nothing may hide outside FluidState.
TEST(FluidFlow, ANewSolverContinuesBitForBit) {
  Config config = test::flow_config({16, 8, 11}, {0.04, 0.025, 0.03}, 1e-3);
  config.fluid->mean_velocity = 0.28;
  config.time.fluid_step = 5e-4;
  const Grid grid = make_grid(config);
  const ExchangeOnFaces exchange = no_exchange(grid);
  for (const Field& m : {exchange.implicit.x, exchange.implicit.y, exchange.implicit.z}) {
    test::set_field(m, grid,
                    [](int i, int j, int k) { return i < 5 && j < 3 && k > 6 ? 900. : 0.; });
  }
  const auto run = [&](bool change_solver) {
    FluidState fluid = make_fluid_state(grid);
    set_turbulent_flow(config, fluid);
    for (const Field& alpha : {fluid.alpha_f, fluid.alpha_f_previous}) {
      test::set_field(alpha, grid,
                      [](int i, int j, int k) { return i < 5 && j < 3 && k > 6 ? 0.5 : 1; });
    }
    auto solver = std::make_unique<FluidSolver>(config, grid);
    solver->fill_ghosts(fluid);
    for (int s = 0; s < 6; ++s) {
      if (s == 3 && change_solver) solver = std::make_unique<FluidSolver>(config, grid);
      solver->advance(fluid, &exchange, config.time.fluid_step);
    }
    return test::to_host(fluid.u.x);
  };
  const auto straight = run(false), changed = run(true);
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) ASSERT_EQ(straight(i, j, k), changed(i, j, k));
}

TEST(FluidFlow, ANumberThatIsNoneShowsInTheReport) {
  const Config config = test::flow_config({16, 4, 3}, {0.04, 0.025, 0.03}, 0);
  const Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid);
  test::set_field(fluid.u.z, grid,
                  [](int i, int j, int k) { return i == 9 && j == 2 && k == 1 ? NAN : 0.; });
  FluidSolver solver(config, grid);
  solver.fill_ghosts(fluid);
  EXPECT_FALSE(std::isfinite(solver.advance(fluid, nullptr, 1e-3).courant));
}

TEST(FluidFlow, TurbulentStartHasTheBulkVelocityNoDivergenceAndASeed) {
  Config config = test::flow_config({24, 12, 18}, {0.1, 0.025, 0.05}, 5e-4);
  config.fluid->mean_velocity = 0.28;
  config.time.fluid_step = 1e-3;
  const Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid), again = make_fluid_state(grid);
  FluidSolver solver(config, grid);
  set_turbulent_flow(config, fluid);
  solver.fill_ghosts(fluid);
  EXPECT_NEAR(solver.bulk_velocity(fluid), 0.28, 1e-14);
  Field rest("rest", grid);
  const double divergence =
      max_each_cell("test", grid,
                    ContinuityResidual<false>{
                        {grid, fluid.u, fluid.alpha_f, fluid.alpha_f, fluid.u, 0, 1, 1e-3, rest}});
  EXPECT_LT(divergence, 1e-14);
  const auto u = test::to_host(fluid.u.x);
  set_turbulent_flow(config, again);
  EXPECT_EQ(test::to_host(again.u.x)(5, 3, 7), u(5, 3, 7));
  config.initial.seed = 2;
  set_turbulent_flow(config, again);
  EXPECT_NE(test::to_host(again.u.x)(5, 3, 7), u(5, 3, 7));
}

}  // namespace
}  // namespace barchan
