// Flows along x and z, and flows that follow a schedule.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "src/fluid/flow_schedule.hpp"
#include "src/initial/initial_flow.hpp"
#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace test;

TEST(Drive, TargetsOfACaseAndOfASchedule) {
  FluidConfig fluid;
  EXPECT_FALSE(Drive(fluid, flow_schedule(fluid)).along_z());
  EXPECT_EQ(Drive(fluid, flow_schedule(fluid)).target(1, {0.1, 0}).x, 0);
  fluid.mean_velocity = 0.3;
  EXPECT_DOUBLE_EQ(Drive(fluid, flow_schedule(fluid)).target(0, {0.1, 0}).x, 0.3);
  fluid.ramp_time = 2;
  EXPECT_DOUBLE_EQ(Drive(fluid, flow_schedule(fluid)).target(0.5, {0.1, 0}).x, 0.15);
  EXPECT_DOUBLE_EQ(Drive(fluid, flow_schedule(fluid)).target(5, {0.1, 0}).x, 0.3);
  EXPECT_FALSE(Drive(fluid, flow_schedule(fluid)).along_z());
  fluid.mean_velocity = 0;
  fluid.schedule = {{.velocity = 0.2}, {.time = 1, .velocity = {0.4, 0.1}, .ramp = 2}};
  const Drive turns(fluid, flow_schedule(fluid));
  EXPECT_TRUE(turns.along_z());
  EXPECT_DOUBLE_EQ(turns.target(0, {}).x, 0.2);
  EXPECT_DOUBLE_EQ(turns.target(1.5, {}).x, 0.25);
  EXPECT_DOUBLE_EQ(turns.target(1.5, {}).z, 0.025);
  EXPECT_DOUBLE_EQ(turns.target(9, {}).z, 0.1);
}

/// Takes 20 steps over `time` [s]. Returns how far the bulk velocity was at most from the wanted
/// one [m/s], in either direction.
double largest_miss(FlowRun run, double time) {
  run.start_uniform(0.1);
  double most = 0;
  for (int s = 0; s < 20; ++s) {
    const Vec2 wanted = run.solver.drive().target(run.fluid.time, {0.1, 0});
    run.advance(time / 20);
    most = std::max({most, std::abs(bulk_velocity(run.fluid) - wanted.x),
                     std::abs(bulk_velocity_across(run.fluid) - wanted.z),
                     std::abs(run.report.bulk_velocity.x - wanted.x),
                     std::abs(run.report.bulk_velocity.z - wanted.z)});
    EXPECT_EQ(run.report.wanted.x, wanted.x);
    EXPECT_EQ(run.report.wanted.z, wanted.z);
  }
  EXPECT_GT(std::abs(bulk_velocity(run.fluid) - 0.1), 0.03) << "it changes";
  return most;
}

/// Fluid fraction of a bumpy bed.
double over_a_bed(int i, int j, int k) {
  return 1 - 0.4 * (j < 4 ? 1 : 0) * std::abs(std::sin(0.7 * i + 0.3)) * std::cos(0.4 * k + 0.1);
}

// A bed takes part of the flow rate in the projection, and the next step gives it back.
TEST(DrivenFlow, FollowsAReversalATurnAndAnOscillation) {
  Config config = laminar({10, 8, 6}, {0.03, 0.02, 0.012}, 1e-5);
  const double time = 0.02, start = time / 5, ramp = 2 * start;
  const std::pair<const char*, std::vector<FlowTarget>> schedules[] = {
      {"reversal", {{.velocity = 0.1}, {start, -0.1, ramp}}},
      {"turn", {{.velocity = 0.1}, {start, {0, 0.1}, ramp}}},
      {"oscillation", {{.velocity = 0.1, .amplitude = {0.05, 0.1}, .period = 0.8 * time}}}};
  for (const auto& [name, schedule] : schedules) {
    config.fluid->schedule = schedule;
    expect_below(fmt::format("{}, bulk velocity from the wanted one [m/s]", name),
                 largest_miss(FlowRun(config), time), 1e-14);
    FlowRun bed(config, Fraction::variable);
    set_field(bed.fluid.alpha_f, bed.grid, over_a_bed);
    set_field(bed.fluid.alpha_f_previous, bed.grid, over_a_bed);
    expect_below(fmt::format("{} over a bed, the same", name), largest_miss(std::move(bed), time),
                 5e-4);
  }
}

// Water between a floor and a plane of symmetry at height H that swings with the bulk velocity
// A sin(w t). In complex numbers, with k = sqrt(i w / nu),
//   u(y) / A = (1 - cosh(k (H - y)) / cosh(k H)) / (1 - tanh(k H) / (k H)),
// which near the floor is Stokes' second problem. It swings along x and, by half, against that
// along z.
// Largest difference over a period, over A.
double error_of_swinging_flow(int rows) {
  using std::numbers::pi;
  const double height = 0.01, nu = 1e-5, amplitude = 0.1, period = 2;
  Config config = laminar({3, rows, 3}, {0.01, height, 0.01}, nu);
  config.fluid->schedule = {
      {.velocity = 0, .amplitude = {amplitude, -amplitude / 2}, .period = period}};
  FlowRun run(config);
  using Complex = std::complex<double>;
  const Complex k = std::sqrt(Complex(0, 2 * pi / period / nu));
  const Complex bulk = 1.0 - std::tanh(k * height) / (k * height);
  const auto exact = [&](int j, double t) {
    const Complex shape = 1.0 - std::cosh(k * (height - run.h.y(j))) / std::cosh(k * height);
    return amplitude * std::imag(shape / bulk * std::exp(Complex(0, 2 * pi * t / period)));
  };
  const int steps = 5 * rows * rows / 2;
  const double dt = period / steps;
  // The velocity at the end of a step is the target at its start.
  set_field(run.fluid.u.z, run.grid, [&](int, int j, int) { return -exact(j, -dt) / 2; });
  run.start([&](int, int j, int) { return exact(j, -dt); });
  double error = 0;
  for (int s = 0; s < steps; ++s) {
    const double t = run.fluid.time;
    run.advance(dt);
    if (s % (steps / 20) != 0) continue;
    const auto u = to_host(run.fluid.u.x), w = to_host(run.fluid.u.z);
    for (int j = 0; j < run.grid.ny; ++j) {
      error = std::max(
          {error, std::abs(u(1, j, 2) - exact(j, t)), std::abs(w(2, j, 1) + exact(j, t) / 2)});
    }
  }
  return error / amplitude;
}

TEST(DrivenFlow, SwingsAsStokesLayerDoes) {
  const double coarse = error_of_swinging_flow(20), fine = error_of_swinging_flow(40);
  expect_below("oscillating flow, error over the amplitude", fine, 3e-3);
  expect_order("oscillating flow", coarse, fine, 2, 0.2);
}

/// Square box of turbulent flow driven along x, or along z. Returns the largest difference of a
/// flow from `turned`, the same with x and z exchanged, and its largest velocity along z [m/s].
std::pair<double, double> compare_turned(const FlowRun& along, const FlowRun& turned) {
  const auto u = to_host(along.fluid.u.x), v = to_host(along.fluid.u.y),
             w = to_host(along.fluid.u.z);
  const auto turned_u = to_host(turned.fluid.u.x), turned_v = to_host(turned.fluid.u.y),
             turned_w = to_host(turned.fluid.u.z);
  double largest = 0, across = 0;
  for_owned_cells(along.grid, [&](int i, int j, int k) {
    largest = std::max({largest, std::abs(u(i, j, k) - turned_w(k, j, i)),
                        std::abs(v(i, j, k) - turned_v(k, j, i)),
                        std::abs(w(i, j, k) - turned_u(k, j, i))});
    across = std::max(across, std::abs(w(i, j, k)));
  });
  return {largest, across};
}

FlowRun turbulent_run(const PlaneVelocity& velocity) {
  Config config = flow_config({16, 12, 16}, {0.03, 0.02, 0.03}, 8e-4);
  config.fluid->mean_velocity = velocity;
  FlowRun run(config);
  set_flow(TurbulentFlow{}, config, run.fluid);
  run.solver.fill_ghosts(run.fluid);
  for (int s = 0; s < 40; ++s) run.advance(5e-4);
  return run;
}

TEST(DrivenFlow, TurbulenceAlongZIsThatAlongXWithXAndZExchanged) {
  const FlowRun along = turbulent_run({0.28, 0.02}), across = turbulent_run({0.02, 0.28});
  const auto [largest, swirl] = compare_turned(along, across);
  EXPECT_GT(swirl, 0.02) << "it is turbulent";
  expect_below("turbulence along z, largest difference [m/s]", largest, 1e-12);
  const double u_star = along.solver.friction_velocity(along.fluid);
  EXPECT_GT(u_star, 0.01);
  EXPECT_NEAR(across.solver.friction_velocity(across.fluid), u_star, 1e-12);
  EXPECT_NEAR(across.report.bulk_velocity.x, 0.02, 1e-14);
}

TEST(DrivenFlow, TurbulenceStartsAlongTheVelocity) {
  Config config = flow_config({16, 12, 16}, {0.03, 0.02, 0.03}, 8e-4);
  for (const PlaneVelocity& velocity :
       {PlaneVelocity{0.28, 0}, PlaneVelocity{-0.2, 0.1}, PlaneVelocity{0.1, -0.2}}) {
    config.fluid->mean_velocity = velocity;
    FluidState fluid = make_fluid_state(make_grid(config));
    set_flow(TurbulentFlow{}, config, fluid);
    EXPECT_NEAR(bulk_velocity(fluid), velocity.x, 1e-14);
    EXPECT_NEAR(bulk_velocity_across(fluid), velocity.z, 1e-14);
  }
}

// The floor does not know x from z: a flow along z through grains that are turned with it is the
// flow along x, turned.
TEST(DrivenFlow, AlongZIsAlongXTurned) {
  const auto run_of = [&](bool turned) {
    const std::array<int, 3> cells = turned ? std::array{6, 8, 10} : std::array{10, 8, 6};
    const std::array<double, 3> size =
        turned ? std::array{0.012, 0.02, 0.03} : std::array{0.03, 0.02, 0.012};
    Config config = laminar(cells, size, 1e-5);
    config.fluid->mean_velocity = turned ? PlaneVelocity{0.02, 0.1} : PlaneVelocity{0.1, 0.02};
    FlowRun run(config, Fraction::variable);
    for (const Field& f : {run.fluid.alpha_f, run.fluid.alpha_f_previous}) {
      set_field(f, run.grid, [&](int i, int j, int k) {
        return turned ? over_a_bed(k, j, i) : over_a_bed(i, j, k);
      });
    }
    run.start_uniform(0);
    for (int s = 0; s < 20; ++s) run.advance(1e-3);
    return run;
  };
  const FlowRun along = run_of(false), turned = run_of(true);
  const auto [largest, across] = compare_turned(along, turned);
  EXPECT_GT(across, 1e-3) << "the flow is three-dimensional";
  expect_below("turned flow, largest difference [m/s]", largest, 1e-10);
  EXPECT_NEAR(turned.fluid.drive.z, along.fluid.drive.x, 1e-6 * std::abs(along.fluid.drive.x));
}

}  // namespace
}  // namespace barchan
