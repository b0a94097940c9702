// Flows with a known answer.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "kernels/fluid/flow_sums.hpp"
#include "src/initial/initial_flow.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_errors.hpp"
#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace test;
using std::numbers::pi;
using test::FlowRun;

TEST(FluidFlow, RampBringsTheBulkVelocityUp) {
  Config config = test::flow_config({4, 6, 3}, {0.01, 0.02, 0.01}, 0);
  config.fluid->mean_velocity = 0.2;
  config.fluid->ramp_time = 0.01;
  FlowRun run(config);
  for (int s = 0; s <= 5; ++s) run.advance(1e-3);
  EXPECT_NEAR(bulk_velocity(run.fluid), 0.1, 1e-13);
  for (int s = 0; s <= 10; ++s) run.advance(1e-3);
  EXPECT_NEAR(bulk_velocity(run.fluid), 0.2, 1e-13);
}

/// Case of a flow with exchange.
Config coupled(Config config) {
  config.grains.emplace();
  return config;
}
ExchangeOnFaces no_exchange(const Grid& grid) { return {make_faces("test", grid)}; }

TEST(FluidFlow, ExchangeIsTakenUpByAUniformMixture) {
  Config config = coupled(test::flow_config({4, 6, 3}, {0.01, 0.02, 0.01}, 0));
  config.fluid->bottom = WallFlow::free_slip;
  FlowRun run(config);
  const auto uniform = [](double value) { return [=](int, int, int) { return value; }; };
  const double alpha = 0.6, u = 0.3, rho = 1000, impulse = -20;
  test::set_field(run.fluid.alpha_f, run.grid, uniform(alpha));
  test::set_field(run.fluid.alpha_f_previous, run.grid, uniform(alpha));
  ExchangeOnFaces exchange = no_exchange(run.grid);
  test::set_field(exchange.impulse.x, run.grid, uniform(impulse));
  run.start_uniform(u);
  run.advance(1e-3, &exchange);
  EXPECT_NEAR(test::to_host(run.fluid.u.x)(1, 2, 1), u + impulse / rho / alpha, 1e-14);
}

/// Rows of fluid at rest, one of which got an impulse, with a drag between them: the velocities
/// solve (rho alpha dy + C) e = impulse dy, C the matrix of the drag, in the whole box alike.
TEST(FluidFlow, InterlayerDragSharesAnImpulse) {
  Config config = coupled(test::flow_config({4, 6, 3}, {0.01, 0.02, 0.01}, 0));
  config.fluid->bottom = WallFlow::free_slip;
  config.fluid->first_cell_height = 2e-3;
  FlowRun run(config);
  const int n = 6;
  ExchangeOnFaces exchange = no_exchange(run.grid);
  exchange.interlayer_drag_x = Field("test: interlayer drag", run.grid);
  exchange.interlayer_drag_z = Field("test: interlayer drag", run.grid);
  const auto alpha = [](int, int j, int) { return 0.4 + 0.1 * j; };
  const auto drag = [](int, int j, int) { return j == 0 || j == 4 ? 0 : 600. * j; };  // two blocks
  const auto impulse = [](int, int j, int) { return j == 1 ? 50. : j == 4 ? -30. : 0; };
  test::set_field(run.fluid.alpha_f, run.grid, alpha);
  test::set_field(run.fluid.alpha_f_previous, run.grid, alpha);
  test::set_field(exchange.interlayer_drag_x, run.grid, drag);
  test::set_field(exchange.interlayer_drag_z, run.grid,
                  [&](int i, int j, int k) { return 2 * drag(i, j, k); });
  for (Field* f : {&exchange.impulse.x, &exchange.impulse.z})
    test::set_field(*f, run.grid, impulse);
  run.start_uniform(0);
  run.advance(1e-3, &exchange);
  const auto expected = [&](double times) {  // with so many times the drag
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd given(n);
    for (int j = 0; j < n; ++j) {
      matrix(j, j) += 1000 * alpha(0, j, 0) * run.h.dy(j);
      given(j) = impulse(0, j, 0) * run.h.dy(j);
      if (j == 0) continue;
      const double c = times * drag(0, j, 0) * run.h.dy(j);
      matrix(j, j) += c, matrix(j - 1, j - 1) += c, matrix(j, j - 1) -= c, matrix(j - 1, j) -= c;
    }
    return Eigen::VectorXd(matrix.ldlt().solve(given));
  };
  const Eigen::VectorXd of_u = expected(1), of_w = expected(2);
  const auto u = test::to_host(run.fluid.u.x), w = test::to_host(run.fluid.u.z);
  for (int j = 0; j < n; ++j) {
    EXPECT_NEAR(u(1, j, 1), of_u(j), 1e-14);
    EXPECT_NEAR(w(1, j, 1), of_w(j), 1e-14);
  }
  EXPECT_GT(std::abs(of_u(3)), 1e-4) << "the drag reaches rows that got nothing";
}

TEST(FluidFlow, MovingSolidFractionConservesMass) {
  Config config = coupled(test::flow_config({16, 8, 12}, {0.04, 0.025, 0.03}, 1e-3));
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
    EXPECT_NEAR(run.report.bulk_velocity.x / 0.28, 1, s <= 2 ? 0.005 : 1e-4) << s;
  }
}

// A block of grains that hinders the flow.
TEST(FluidFlow, AHinderedFlowConservesMassAndKeepsItsBulkVelocity) {
  Config config = coupled(test::flow_config({16, 8, 12}, {0.04, 0.025, 0.03}, 1e-3));
  config.fluid->mean_velocity = 0.28;
  FlowRun run(config);
  const ExchangeOnFaces exchange = no_exchange(run.grid);
  const auto in_block = [](double value) {
    return
        [=](int i, int j, int k) { return i > 4 && i < 9 && j < 5 && k > 2 && k < 8 ? value : 0; };
  };
  const auto alpha = [&](int i, int j, int k) { return 1 - in_block(0.4)(i, j, k); };
  test::set_field(run.fluid.alpha_f_previous, run.grid, alpha);
  test::set_field(run.fluid.alpha_f, run.grid, alpha);
  run.start_uniform(0.28);
  for (int s = 1; s <= 20; ++s) {
    run.advance(5e-4, &exchange);
    EXPECT_LT(run.report.continuity_residual, 1e-6);
    // The drive learns what the block takes of it: 8e-5 would stay, did it not.
    EXPECT_NEAR(run.report.bulk_velocity.x / 0.28, 1, s <= 5 ? 0.01 : 1e-5) << s;
  }
}

/// A new solver that goes on from a state must not notice: nothing may hide outside FluidState.
TEST(FluidFlow, ANewSolverContinuesBitForBit) {
  Config config = coupled(test::flow_config({16, 8, 11}, {0.04, 0.025, 0.03}, 1e-3));
  config.fluid->mean_velocity = 0.28;
  config.time.fluid_step = 5e-4;
  const Grid grid = make_grid(config);
  ExchangeOnFaces exchange = no_exchange(grid);
  exchange.interlayer_drag_x = exchange.interlayer_drag_z = Field("test: interlayer drag", grid);
  const auto in_corner = [](double value) {
    return [=](int i, int j, int k) { return i < 5 && j < 3 && k > 6 ? value : 0.; };
  };
  for (Field m : {exchange.impulse.x, exchange.impulse.y, exchange.impulse.z})
    test::set_field(m, grid, in_corner(-0.9));
  test::set_field(exchange.interlayer_drag_x, grid, in_corner(300));
  const auto run = [&](bool change_solver) {
    FluidState fluid = make_fluid_state(grid);
    set_flow(TurbulentFlow{}, config, fluid);
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
  set_flow(TurbulentFlow{}, config, fluid);
  run.solver.fill_ghosts(fluid);
  EXPECT_NEAR(bulk_velocity(fluid), 0.28, 1e-14);
  Field rest("rest", run.grid);
  const ContinuityResidual<Fraction::uniform> residual{
      {run.grid, fluid.u, fluid.alpha_f, fluid.alpha_f, fluid.u, 0, 1, 1e-3, rest}};
  EXPECT_LT(max_each_cell("test", run.grid, residual), 1e-14);
  const auto of_seed = [&](int seed) {
    config.initial.seed = seed;
    FluidState again = make_fluid_state(run.grid);
    set_flow(TurbulentFlow{}, config, again);
    return test::to_host(again.u.x)(5, 3, 7);
  };
  const double u = test::to_host(fluid.u.x)(5, 3, 7);
  EXPECT_EQ(of_seed(1), u);
  EXPECT_NE(of_seed(2), u);
}

// --- Laminar flows between walls on stretched rows: order of profile, drive and wall shear.

constexpr double kHeight = 0.02, kNu = 1e-5, kVelocity = 0.1;  // [m], [m^2/s], [m/s]
constexpr double kViscousTime = kHeight * kHeight / kNu;       // [s]

/// A channel of `rows`, the last `span` times the first, for flow along x that depends on y alone.
struct Channel : FlowRun {
  double first;  // height of the first row [m]

  Channel(int rows, double span, WallFlow top, double bulk, double top_velocity)
      : FlowRun(make_config(rows, span, top, bulk, top_velocity)),
        first(config.fluid->first_cell_height) {}

  struct ProfileError {
    double rms = 0, largest = 0;  // over the height
  };
  /// u - exact(y), over `scale`.
  template <class Exact>
  ProfileError profile_error(const Exact& exact, double scale) const {
    const auto u = test::to_host(fluid.u.x);
    ProfileError e;
    for (int j = 0; j < grid.ny; ++j) {
      const double error = std::abs(u(0, j, 0) - exact(h.y(j))) / scale;
      e.rms += error * error * h.dy(j) / kHeight;
      e.largest = std::max(e.largest, error);
    }
    e.rms = std::sqrt(e.rms);
    return e;
  }
  double friction_error(double exact) const {
    return std::abs(solver.friction_velocity(fluid) / exact - 1);
  }

 private:
  static Config make_config(int rows, double span, WallFlow top, double bulk, double top_velocity) {
    Config config = test::flow_config({2, rows, 2}, {0.01, kHeight, 0.01},
                                      test::first_row(kHeight, rows, span));
    config.fluid->kinematic_viscosity = kNu;
    config.fluid->top = top;
    config.fluid->mean_velocity = bulk;
    config.fluid->top_velocity = top_velocity;
    return config;
  }
};

struct ChannelErrors {
  double drive, friction;  // relative to theirs
  Channel::ProfileError profile;
};

/// Half channel from a plug to the steady parabola at a fixed bulk velocity U.
ChannelErrors half_channel(int rows) {
  Channel run(rows, 3, WallFlow::free_slip, kVelocity, 0);
  run.start_uniform(kVelocity);
  // Perturbations die at least as exp(-20 nu t / depth^2): by exp(-24) at the end.
  const double dt = 0.15 * run.first * run.first / kNu;
  for (int s = static_cast<int>(1.2 * kViscousTime / dt); s >= 0; --s) run.advance(dt);
  EXPECT_NEAR(bulk_velocity(run.fluid), kVelocity, 1e-14);
  const double drive = 3 * kNu * kVelocity / (kHeight * kHeight);
  return {std::abs(run.report.drive.x / drive - 1), run.friction_error(std::sqrt(drive * kHeight)),
          run.profile_error([&](double y) { return drive / (2 * kNu) * y * (2 * kHeight - y); },
                            kVelocity)};
}

/// The drive finds 3 rho nu U / depth^2, and the wall shear is its image.
TEST(FluidLaminar, HalfChannelDriveShearAndProfileAreSecondOrder) {
  const ChannelErrors coarse = half_channel(12), fine = half_channel(24);
  expect_order("half channel, drive", coarse.drive, fine.drive, 2, 0.15);
  expect_order("half channel, friction velocity", coarse.friction, fine.friction, 2, 0.15);
  expect_order("half channel, profile", coarse.profile.rms, fine.profile.rms, 2, 0.15);
  expect_below("half channel, drive, 24 rows", fine.drive, 2e-3);
  expect_below("half channel, friction velocity, 24 rows", fine.friction, 2e-3);
  expect_below("half channel, profile over U, 24 rows, RMS", fine.profile.rms, 1e-3);
  expect_below("half channel, profile over U, 12 rows, largest", coarse.profile.largest, 4e-3);
}

/// u = sin(pi y / h) exp(-nu pi^2 t / h^2) between two walls at rest; shear nu pi / h at the walls.
struct ShearErrors {
  double profile, friction;
};
ShearErrors decaying_shear(int rows) {
  Channel run(rows, 2.5, WallFlow::no_slip, 0, 0);
  const auto profile = [](double y) { return std::sin(pi * y / kHeight); };
  run.start([&](int, int j, int) { return profile(run.h.y(j)); });
  const double end = 0.1 * kViscousTime, dt = 0.1 * run.first * run.first / kNu;
  run.advance_over(end, static_cast<int>(std::ceil(end / dt)));
  const double decay = std::exp(-pi * pi * 0.1);
  return {run.profile_error([&](double y) { return decay * profile(y); }, decay).rms,
          run.friction_error(std::sqrt(kNu * decay * pi / kHeight))};
}

TEST(FluidLaminar, ShearBetweenWallsAtRestDecaysAtTheKnownRate) {
  const ShearErrors coarse = decaying_shear(16), fine = decaying_shear(32);
  expect_order("decaying shear, profile", coarse.profile, fine.profile, 2, 0.15);
  expect_order("decaying shear, friction velocity", coarse.friction, fine.friction, 2, 0.15);
}

/// Couette flow from rest, the lid at U: u/U = y/h + sum 2/(n pi) (-1)^n sin(n pi y/h) exp(-n^2
/// pi^2 T), T = nu t/h^2. RMS error over U at T = 0.05; afterwards steady.
struct CouetteErrors {
  double starting, steady, friction;
};
CouetteErrors couette(int rows) {
  Channel run(rows, 2.5, WallFlow::no_slip, 0, kVelocity);
  run.start_uniform(0);
  const double dt = 0.1 * run.first * run.first / kNu;
  const auto error_after = [&](double duration, double whole) {  // in viscous times
    run.advance_over(duration * kViscousTime,
                     static_cast<int>(std::ceil(duration * kViscousTime / dt)));
    const auto exact = [&](double y) {
      double sum = y / kHeight;
      for (int n = 1; n < 40; ++n) {
        sum += 2 / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::sin(n * pi * y / kHeight) *
               std::exp(-n * n * pi * pi * whole);
      }
      return sum * kVelocity;
    };
    return run.profile_error(exact, kVelocity).rms;
  };
  const double starting = error_after(0.05, 0.05);
  const double steady = error_after(3.2, 3.25);  // what is left dies as exp(-pi^2 T)
  return {starting, steady, run.friction_error(std::sqrt(kNu * kVelocity / kHeight))};
}

TEST(FluidLaminar, CouetteFlowStartsAndBecomesLinear) {
  const CouetteErrors coarse = couette(16), fine = couette(32);
  expect_order("Couette flow while starting", coarse.starting, fine.starting, 2, 0.15);
  expect_below("Couette flow, steady profile", fine.steady, 1e-12);
  expect_below("Couette flow, u*", fine.friction, 1e-12);
}

}  // namespace
}  // namespace barchan
