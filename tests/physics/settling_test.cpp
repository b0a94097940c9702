// One grain settles: terminal velocity and transient, in still fluid and two-way coupled.
#include "tests/support/coupled_run.hpp"
#include "tests/support/drag_reference.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using test::CoupledRun;
using test::SettlingSphere;
using test::Water;

struct Sphere {
  double d, rho_p = 2500;
  Water water = {};
  std::string label = {};  // of its saved transient, if that is to be kept
};

struct Outcome {
  double terminal = 0;         // at the end [m/s]
  double sideways = 0;         // speed across gravity, the same [m/s]
  double transient_error = 0;  // largest |v - v_exact| / v_exact at the end of any step
};

/// Releases a sphere at rest and follows it over `times` response times; gravity along -y.
Outcome settle(Config config, const Sphere& s, double times) {
  config.grains->gravity = {0, -9.81, 0};
  config.grains->density = s.rho_p;
  InitialGrains grain;
  // Off the symmetry planes of the cells, so that interpolation takes part.
  test::add_grain(grain, s.d,
                  {0.413 * config.size[0], 0.937 * config.size[1], 0.571 * config.size[2]});
  CoupledRun run(config, grain);
  SettlingSphere exact(s.d, s.rho_p, s.water);
  Outcome out;
  const int steps = static_cast<int>(times * exact.response_time() / config.time.fluid_step);
  for (int n = 1; n <= steps; ++n) {
    run.advance();
    exact.advance(config.time.fluid_step);
    const Vec3 u = run.velocity_of(1);
    out.terminal = -u.y;
    out.sideways = std::hypot(u.x, u.z);
    out.transient_error =
        std::max(out.transient_error, std::abs(out.terminal / exact.velocity() - 1));
    if (!s.label.empty() && n % std::max(1, steps / 60) == 0) {
      test::save_result("settling_transients", {{"sphere", s.label},
                                                {"t", n * config.time.fluid_step},
                                                {"v", out.terminal},
                                                {"theory", exact.velocity()}});
    }
  }
  return out;
}

void set_steps(Config& config, double step) {
  config.time.fluid_step = step;
  config.time.grain_step = step / 10;
}

Config in_still_fluid(const Sphere& s, double step) {
  const SettlingSphere sphere(s.d, s.rho_p, s.water);
  const double fall = 12 * sphere.response_time() * sphere.stokes_velocity();
  Config config = test::still_water({50 * s.d, 2 * fall + 40 * s.d, 50 * s.d});
  config.grains->ambient->density = s.water.rho;
  config.grains->ambient->kinematic_viscosity = s.water.mu / s.water.rho;
  config.grains->skin = 0.2 * s.d;
  set_steps(config, step);
  return config;
}

/// Cubic cells of edge `cell`, 8 of them in each direction.
Config in_flowing_water(const Sphere& s, double cell, double step) {
  const double edge = 8 * cell;
  Config config = test::water_box({8, 8, 8}, {edge, edge, edge});
  config.fluid->density = s.water.rho;
  config.fluid->kinematic_viscosity = s.water.mu / s.water.rho;
  config.grains->skin = 0.2 * s.d;
  set_steps(config, step);
  return config;
}

void check(const std::string& what, const Outcome& got, double reference, double tolerance) {
  test::expect_relative(what + ", terminal velocity [m/s]", got.terminal, reference, tolerance);
  test::expect_below(what + ", transient", got.transient_error, 0.01);
  test::expect_below(what + ", sideways [m/s]", got.sideways, 1e-5);
}

/// Calls check_row for each of Table II's grains, or of ten Cate's spheres.
template <class Check>
void for_spheres(const std::string& table, const Check& check_row) {
  for (const auto& row : test::reference_table(table)) {
    if (row.contains("case")) {
      check_row(
          Sphere{
              0.015, 1120, {test::number(row, "rho_f"), test::number(row, "mu_f")}, row.at("case")},
          test::number(row, "u_SN"));
    } else {
      check_row(Sphere{.d = test::number(row, "d"), .label = "d = " + row.at("d")},
                test::number(row, "v_SN"));
    }
  }
}

void expect_settling_alone(Sphere s, double step, double reference) {
  const std::string claim = "still, " + std::exchange(s.label, "");
  check(claim, settle(in_still_fluid(s, step), s, 10), reference, 0.001);
}

/// Cells 40 diameters wide: what the grain stirs up is then small against its own velocity.
void expect_settling_coupled(const Sphere& s, double step, double times, double reference) {
  check("coupled, " + s.label, settle(in_flowing_water(s, 40 * s.d, step), s, times), reference,
        0.005);
}

double response_time(const Sphere& s) {
  return SettlingSphere(s.d, s.rho_p, s.water).response_time();
}

TEST(Settling, TableTwoGrainsInStillWater) {
  for_spheres("seed_grain_derived_numbers.csv",
              [](const Sphere& s, double v) { expect_settling_alone(s, 2.5e-5, v); });
}

TEST(Settling, TableTwoGrainsCoupled) {
  for_spheres("seed_grain_derived_numbers.csv",
              [](const Sphere& s, double v) { expect_settling_coupled(s, 1e-4, 10, v); });
}

TEST(Settling, TenCatesSphereInStillFluid) {
  for_spheres("settling_ten_cate2002.csv", [](const Sphere& s, double v) {
    expect_settling_alone(s, response_time(s) / 400, v);
  });
}

TEST(Settling, TenCatesSphereCoupled) {
  for_spheres("settling_ten_cate2002.csv", [](const Sphere& s, double v) {
    expect_settling_coupled(s, response_time(s) / 100, 8, v);
  });
}

/// A point force in smaller cells drags its fluid along and falls faster; the excess must vanish as
/// the cells grow. In Stokes flow it would be d/(3 h) or so; the grain of Table II leaves its wake.
TEST(Settling, SelfInducedFlowVanishesWithCellSize) {
  const Sphere grain{.d = 2e-4};
  const double alone = SettlingSphere(grain.d, grain.rho_p, {}).terminal_velocity();
  double last = 1;
  for (const double cells : {5., 10., 20., 40.}) {
    const Outcome got = settle(in_flowing_water(grain, cells * grain.d, 1e-4), grain, 10);
    const double excess = got.terminal / alone - 1;
    test::save_result("settling_excess", {{"cell_over_d", cells}, {"excess", excess}});
    EXPECT_LT(std::abs(excess), 0.5 * last);
    last = std::abs(excess);
  }
  EXPECT_LT(last, 0.005);
}

/// The step of the shipped cases, 1/27 of the response time: drag coefficient and u_f lag by up to
/// a step.
TEST(Settling, TransientWithTheStepsOfTheShippedCases) {
  const Sphere grain{.d = 2e-4};
  Config config = in_flowing_water(grain, 40 * grain.d, 2.5e-4);
  config.time.grain_step = 2.5e-6;
  const Outcome got = settle(config, grain, 10);
  check("coupled, step 2.5e-4 s", got, SettlingSphere(2e-4, 2500, {}).terminal_velocity(), 0.005);
}

}  // namespace
}  // namespace barchan
