// Laminar flows between walls on stretched rows: order of profile, drive and wall shear.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "src/fluid/fluid_solver.hpp"
#include "tests/support/flow_errors.hpp"

namespace barchan {
namespace {

using std::numbers::pi;
using test::HostGrid;

struct ChannelErrors {
  double drive, friction, profile;  // relative to drive, friction velocity and bulk velocity
};

/// Half channel from a plug to the steady parabola at a fixed bulk velocity.
ChannelErrors half_channel(int rows) {
  const double depth = 0.02, nu = 1e-5, bulk = 0.1;
  const double first = test::first_row(depth, rows, 3);
  Config config = test::flow_config({2, rows, 1}, {0.01, depth, 0.01}, first);
  config.fluid->kinematic_viscosity = nu;
  config.fluid->mean_velocity = bulk;
  const Grid grid = make_grid(config);
  const HostGrid h(grid);
  FluidState fluid = make_fluid_state(grid);
  test::set_field(fluid.u.x, grid, [&](int, int, int) { return bulk; });
  FluidSolver solver(config, grid);
  solver.fill_ghosts(fluid);
  FluidStepReport report;
  // Perturbations die at least as exp(-20 nu t / depth^2): by exp(-24) at the end.
  const double dt = 0.15 * first * first / nu;
  for (int s = static_cast<int>(1.2 * depth * depth / nu / dt); s >= 0; --s)
    report = solver.advance(fluid, nullptr, dt);

  const double drive = 3 * nu * bulk / (depth * depth), u_star = std::sqrt(drive * depth);
  const auto u = test::to_host(fluid.u.x);
  double sum = 0;
  for (int j = 0; j < rows; ++j) {
    const double exact = drive / (2 * nu) * h.y(j) * (2 * depth - h.y(j));
    sum += std::pow(u(0, j, 0) - exact, 2) * h.dy(j) / depth;
  }
  return {std::abs(report.drive / drive - 1),
          std::abs(solver.friction_velocity(fluid) / u_star - 1), std::sqrt(sum) / bulk};
}

/// The drive finds 3 rho nu U / depth^2, and the wall shear is its image.
TEST(FluidLaminar, HalfChannelDriveShearAndProfileAreSecondOrder) {
  const ChannelErrors coarse = half_channel(12), fine = half_channel(24);
  const auto check = [](const char* what, double e, double e_half) {
    std::printf(
        "[ measured ] laminar half channel, %s: error %.2e, %.2e (12, 24 rows), order %.3f "
        "(reference 2, tolerance 0.15)\n",
        what, e, e_half, std::log2(e / e_half));
    EXPECT_NEAR(std::log2(e / e_half), 2, 0.15) << what;
  };
  check("drive", coarse.drive, fine.drive);
  check("friction velocity", coarse.friction, fine.friction);
  check("profile", coarse.profile, fine.profile);
  EXPECT_LT(fine.drive, 2e-3);
}

/// u = sin(pi y / h) exp(-nu pi^2 t / h^2) between two walls at rest; shear nu pi / h at the walls.
struct ShearErrors {
  double profile, friction;
};
ShearErrors decaying_shear(int rows) {
  const double height = 0.02, nu = 1e-5;
  const double first = test::first_row(height, rows, 2.5);
  Config config = test::flow_config({2, rows, 2}, {0.01, height, 0.01}, first);
  config.fluid->kinematic_viscosity = nu;
  config.fluid->bottom = config.fluid->top = WallFlow::no_slip;
  const Grid grid = make_grid(config);
  const HostGrid h(grid);
  FluidState fluid = make_fluid_state(grid);
  const auto profile = [&](double y) { return std::sin(pi * y / height); };
  test::set_field(fluid.u.x, grid, [&](int, int j, int) { return profile(h.y(j)); });
  FluidSolver solver(config, grid);
  solver.fill_ghosts(fluid);
  const double end = 0.1 * height * height / nu;
  const int steps = static_cast<int>(std::ceil(end / (0.1 * first * first / nu)));
  for (int s = 0; s < steps; ++s) solver.advance(fluid, nullptr, end / steps);

  const double decay = std::exp(-nu * pi * pi * end / (height * height));
  const auto u = test::to_host(fluid.u.x);
  double sum = 0;
  for (int j = 0; j < rows; ++j)
    sum += std::pow(u(0, j, 0) - decay * profile(h.y(j)), 2) * h.dy(j) / height;
  const double u_star = std::sqrt(nu * decay * pi / height);
  return {std::sqrt(sum) / decay, std::abs(solver.friction_velocity(fluid) / u_star - 1)};
}

TEST(FluidLaminar, ShearBetweenWallsAtRestDecaysAtTheKnownRate) {
  const ShearErrors coarse = decaying_shear(16), fine = decaying_shear(32);
  const double profile = std::log2(coarse.profile / fine.profile),
               friction = std::log2(coarse.friction / fine.friction);
  std::printf(
      "[ measured ] decaying shear: order of profile %.3f, of friction velocity %.3f (reference 2, "
      "tolerance 0.15); errors on 32 rows %.2e, %.2e\n",
      profile, friction, fine.profile, fine.friction);
  EXPECT_NEAR(profile, 2, 0.15);
  EXPECT_NEAR(friction, 2, 0.15);
}

/// Couette flow from rest, the lid at U: u/U = y/h + sum 2/(n pi) (-1)^n sin(n pi y/h) exp(-n^2
/// pi^2 T), T = nu t/h^2. RMS error over U at T = 0.05; afterwards steady.
struct CouetteErrors {
  double starting, steady, friction;
};
CouetteErrors couette(int rows) {
  const double height = 0.02, nu = 1e-5, lid = 0.1;
  const double first = test::first_row(height, rows, 2.5);
  Config config = test::flow_config({2, rows, 2}, {0.01, height, 0.01}, first);
  config.fluid->kinematic_viscosity = nu;
  config.fluid->bottom = config.fluid->top = WallFlow::no_slip;
  config.fluid->top_velocity = lid;
  const Grid grid = make_grid(config);
  const HostGrid h(grid);
  FluidState fluid = make_fluid_state(grid);
  FluidSolver solver(config, grid);
  solver.fill_ghosts(fluid);
  const double scale = height * height / nu, dt = 0.1 * first * first / nu;
  const auto advance = [&](double duration) {
    const int steps = static_cast<int>(std::ceil(duration / dt));
    for (int s = 0; s < steps; ++s) solver.advance(fluid, nullptr, duration / steps);
  };
  const auto error = [&](double decay_time) {
    const auto u = test::to_host(fluid.u.x);
    double sum = 0;
    for (int j = 0; j < rows; ++j) {
      double exact = h.y(j) / height;
      for (int n = 1; n < 40; ++n) {
        exact += 2 / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::sin(n * pi * h.y(j) / height) *
                 std::exp(-n * n * pi * pi * decay_time);
      }
      sum += std::pow(u(0, j, 0) / lid - exact, 2) * h.dy(j) / height;
    }
    return std::sqrt(sum);
  };
  CouetteErrors errors{};
  advance(0.05 * scale);
  errors.starting = error(0.05);
  advance(3.2 * scale);  // what is left dies as exp(-pi^2 T)
  errors.steady = error(3.25);
  const double u_star = std::sqrt(nu * lid / height);
  errors.friction = std::abs(solver.friction_velocity(fluid) / u_star - 1);
  return errors;
}

TEST(FluidLaminar, CouetteFlowStartsAndBecomesLinear) {
  const CouetteErrors coarse = couette(16), fine = couette(32);
  const double order = std::log2(coarse.starting / fine.starting);
  std::printf(
      "[ measured ] Couette flow: order while starting %.3f (reference 2, tolerance 0.15), steady "
      "profile off by %.1e, u* by %.1e (reference 0, tolerance 1e-12)\n",
      order, fine.steady, fine.friction);
  EXPECT_NEAR(order, 2, 0.15);
  EXPECT_LT(fine.steady, 1e-12);
  EXPECT_LT(fine.friction, 1e-12);
}

}  // namespace
}  // namespace barchan
