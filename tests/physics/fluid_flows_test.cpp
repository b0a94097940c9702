// Flows with a known answer.
#include <gtest/gtest.h>

#include <numbers>

#include "kernels/fluid/flow_sums.hpp"
#include "src/fluid/initial_flow.hpp"
#include "src/parallel/launch.hpp"
#include "tests/support/flow_run.hpp"

namespace barchan {
namespace {

using std::numbers::pi;
using test::FlowRun;

TEST(FluidFlow, RampBringsTheBulkVelocityUp) {
  Config config = test::flow_config({4, 6, 3}, {0.01, 0.02, 0.01}, 0);
  config.fluid->mean_velocity = 0.2;
  config.fluid->ramp_time = 0.01;
  FlowRun run(config);
  for (int s = 0; s <= 5; ++s) run.advance(1e-3);
  EXPECT_NEAR(run.solver.bulk_velocity(run.fluid), 0.1, 1e-13);
  for (int s = 0; s <= 10; ++s) run.advance(1e-3);
  EXPECT_NEAR(run.solver.bulk_velocity(run.fluid), 0.2, 1e-13);
}

ExchangeOnFaces no_exchange(const Grid& grid) {
  return {test::make_faces(grid), test::make_faces(grid)};
}

TEST(FluidFlow, ExchangeIsTakenUpByAUniformMixture) {
  Config config = test::flow_config({4, 6, 3}, {0.01, 0.02, 0.01}, 0);
  config.fluid->bottom = WallFlow::free_slip;
  FlowRun run(config);
  const auto uniform = [](double value) { return [=](int, int, int) { return value; }; };
  const double alpha = 0.6, u = 0.3, rho = 1000, implicit = 1500, impulse = -20;
  test::set_field(run.fluid.alpha_f, run.grid, uniform(alpha));
  test::set_field(run.fluid.alpha_f_previous, run.grid, uniform(alpha));
  ExchangeOnFaces exchange = no_exchange(run.grid);
  test::set_field(exchange.impulse.x, run.grid, uniform(impulse));
  test::set_field(exchange.implicit.x, run.grid, uniform(implicit));
  run.start_uniform(u);
  run.advance(1e-3, &exchange);
  EXPECT_NEAR(test::to_host(run.fluid.u.x)(1, 2, 1), u + impulse / rho / (alpha + implicit / rho),
              1e-14);
}

TEST(FluidFlow, MovingSolidFractionConservesMass) {
  Config config = test::flow_config({16, 8, 12}, {0.04, 0.025, 0.03}, 1e-3);
  config.fluid->mean_velocity = 0.28;
  FlowRun run(config);
  const ExchangeOnFaces exchange = no_exchange(run.grid);
  const double dt = 5e-4;
  const auto set_alpha = [&](Field& alpha, double t) {
    test::set_field(alpha, run.grid, [&](int i, int j, int k) {
      const double wave = std::sin(2 * pi * (run.h.x(i) - 0.1 * t) / 0.04) *
                          std::cos(2 * pi * (run.h.z(k) + 0.05 * t) / 0.03);
      return 0.7 + 0.25 * wave * std::cos(pi * run.h.y(j) / 0.025);
    });
  };
  set_alpha(run.fluid.alpha_f_previous, 0);
  set_alpha(run.fluid.alpha_f, 0);
  run.start_uniform(0.28);
  for (int s = 1; s <= 10; ++s) {
    set_alpha(run.fluid.alpha_f_previous, (s - 1) * dt);
    set_alpha(run.fluid.alpha_f, s * dt);
    run.advance(dt, &exchange);
    EXPECT_LT(run.report.continuity_residual, 1e-6);
    // The drive learns in two steps what the projection takes of it.
    EXPECT_NEAR(run.report.bulk_velocity / 0.28, 1, s <= 2 ? 0.005 : 1e-4) << s;
  }
}

/// A new solver that goes on from a state must not notice: nothing may hide outside FluidState.
TEST(FluidFlow, ANewSolverContinuesBitForBit) {
  Config config = test::flow_config({16, 8, 11}, {0.04, 0.025, 0.03}, 1e-3);
  config.fluid->mean_velocity = 0.28;
  config.time.fluid_step = 5e-4;
  const Grid grid = make_grid(config);
  const ExchangeOnFaces exchange = no_exchange(grid);
  for (Field m : {exchange.implicit.x, exchange.implicit.y, exchange.implicit.z}) {
    test::set_field(m, grid,
                    [](int i, int j, int k) { return i < 5 && j < 3 && k > 6 ? 900. : 0.; });
  }
  const auto run = [&](bool change_solver) {
    FluidState fluid = make_fluid_state(grid);
    set_turbulent_flow(config, fluid);
    for (Field alpha : {fluid.alpha_f, fluid.alpha_f_previous}) {
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
  test::for_owned_cells(
      grid, [&](int i, int j, int k) { ASSERT_EQ(straight(i, j, k), changed(i, j, k)); });
}

TEST(FluidFlow, ANumberThatIsNoneShowsInTheReport) {
  const Config config = test::flow_config({16, 4, 3}, {0.04, 0.025, 0.03}, 0);
  FlowRun run(config);
  test::set_field(run.fluid.u.z, run.grid,
                  [](int i, int j, int k) { return i == 9 && j == 2 && k == 1 ? NAN : 0.; });
  run.start_uniform(0);
  EXPECT_FALSE(std::isfinite(run.advance(1e-3).courant));
}

TEST(FluidFlow, TurbulentStartHasTheBulkVelocityNoDivergenceAndASeed) {
  Config config = test::flow_config({24, 12, 18}, {0.1, 0.025, 0.05}, 5e-4);
  config.fluid->mean_velocity = 0.28;
  config.time.fluid_step = 1e-3;
  FlowRun run(config);
  FluidState& fluid = run.fluid;
  set_turbulent_flow(config, fluid);
  run.solver.fill_ghosts(fluid);
  EXPECT_NEAR(run.solver.bulk_velocity(fluid), 0.28, 1e-14);
  Field rest("rest", run.grid);
  const ContinuityResidual<false> residual{
      {run.grid, fluid.u, fluid.alpha_f, fluid.alpha_f, fluid.u, 0, 1, 1e-3, rest}};
  EXPECT_LT(max_each_cell("test", run.grid, residual), 1e-14);
  const auto of_seed = [&](int seed) {
    config.initial.seed = seed;
    FluidState again = make_fluid_state(run.grid);
    set_turbulent_flow(config, again);
    return test::to_host(again.u.x)(5, 3, 7);
  };
  const double u = test::to_host(fluid.u.x)(5, 3, 7);
  EXPECT_EQ(of_seed(1), u);
  EXPECT_NE(of_seed(2), u);
}

}  // namespace
}  // namespace barchan
