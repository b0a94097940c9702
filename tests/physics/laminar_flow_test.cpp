// Laminar flows between walls on stretched rows: order of profile, drive and wall shear.
#include <numbers>

#include "tests/support/flow_errors.hpp"
#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace testing;
using std::numbers::pi;
using test::FlowRun;

constexpr double kHeight = 0.02, kNu = 1e-5, kVelocity = 0.1;  // [m], [m^2/s], [m/s]
constexpr double kViscousTime = kHeight * kHeight / kNu;       // [s]

/// A channel of `rows`, the last `span` times the first, for flow along x that depends on y alone.
struct Channel : FlowRun {
  double first;  // height of the first row [m]

  Channel(int rows, double span, WallFlow top, double bulk, double top_velocity)
      : FlowRun(make_config(rows, span, top, bulk, top_velocity)),
        first(config.fluid->first_cell_height) {}

  /// RMS over the height of u - exact(y).
  template <class Exact>
  double profile_error(const Exact& exact) const {
    const auto u = test::to_host(fluid.u.x);
    double sum = 0;
    for (int j = 0; j < grid.ny; ++j) {
      sum += std::pow(u(0, j, 0) - exact(h.y(j)), 2) * h.dy(j) / kHeight;
    }
    return std::sqrt(sum);
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
  double drive, friction, profile;  // relative to drive, friction velocity and bulk velocity
};

/// Half channel from a plug to the steady parabola at a fixed bulk velocity U.
ChannelErrors half_channel(int rows) {
  Channel run(rows, 3, WallFlow::free_slip, kVelocity, 0);
  run.start_uniform(kVelocity);
  // Perturbations die at least as exp(-20 nu t / depth^2): by exp(-24) at the end.
  const double dt = 0.15 * run.first * run.first / kNu;
  for (int s = static_cast<int>(1.2 * kViscousTime / dt); s >= 0; --s) run.advance(dt);
  EXPECT_NEAR(run.solver.bulk_velocity(run.fluid), kVelocity, 1e-14);
  const double drive = 3 * kNu * kVelocity / (kHeight * kHeight);
  return {std::abs(run.report.drive / drive - 1), run.friction_error(std::sqrt(drive * kHeight)),
          run.profile_error([&](double y) { return drive / (2 * kNu) * y * (2 * kHeight - y); }) /
              kVelocity};
}

/// The drive finds 3 rho nu U / depth^2, and the wall shear is its image.
TEST(FluidLaminar, HalfChannelDriveShearAndProfileAreSecondOrder) {
  const ChannelErrors coarse = half_channel(12), fine = half_channel(24);
  expect_order("half channel, drive", coarse.drive, fine.drive, 2, 0.15);
  expect_order("half channel, friction velocity", coarse.friction, fine.friction, 2, 0.15);
  expect_order("half channel, profile", coarse.profile, fine.profile, 2, 0.15);
  expect_below("half channel, drive, 24 rows", fine.drive, 2e-3);
  expect_below("half channel, friction velocity, 24 rows", fine.friction, 2e-3);
  expect_below("half channel, profile over U, 24 rows", fine.profile, 1e-3);
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
  return {run.profile_error([&](double y) { return decay * profile(y); }) / decay,
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
    return run.profile_error([&](double y) {
      double exact = y / kHeight;
      for (int n = 1; n < 40; ++n) {
        exact += 2 / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::sin(n * pi * y / kHeight) *
                 std::exp(-n * n * pi * pi * whole);
      }
      return exact * kVelocity;
    }) / kVelocity;
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
