// A cylinder in a laminar channel: Schaefer & Turek, in Flow Simulation with High-Performance
// Computers II, Notes Numer. Fluid Mech. 52, 547 (1996), cases 2D-1 and 2D-2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr double kDiameter = 0.1, kHeight = 0.41, kNu = 1e-3, kRho = 1;  // [m], [m^2/s], [kg/m^3]
constexpr double kInlet = 0.1, kCentreX = kInlet + 0.2, kCentreY = 0.2, kLength = kInlet + 2.2;

/// Channel of the benchmark, periodic, with its bulk velocity U held. The benchmark has a parabola
/// two diameters before the cylinder, where without it the flow already knows of the cylinder. So
/// after each step the fluid of the first diameter of the domain is given the parabola. `n` cells
/// to a diameter.
struct Benchmark {
  double bulk;
  FlowRun run;
  double dt;

  Benchmark(double u, int n)
      : bulk(u),
        run(config_of(u, n, kLength)),
        dt(std::min(0.22 * kDiameter / n / u, 0.1 * kDiameter * kDiameter / n / n / kNu)) {
    run.start([&](int, int j, int) { return parabola(run.h.y(j)); });
    run.solver.flow_around_bodies(run.fluid);
  }
  void advance() {
    run.advance(dt);
    const int last = static_cast<int>(std::lround(kInlet / run.grid.dx));
    run.hold(run.fluid.u.x, last, [&](int j) { return parabola(run.h.y(j)); });
    run.hold(run.fluid.u.y, last, [](int) { return 0.; });
    run.solver.fill_ghosts(run.fluid);
  }
  double parabola(double y) const { return 6 * bulk * y * (kHeight - y) / (kHeight * kHeight); }
  static Config config_of(double u, int n, double length) {
    const double h = kDiameter / n;
    Config config = flow_config(
        {static_cast<int>(std::lround(length / h)), static_cast<int>(std::lround(kHeight / h)), 1},
        {length, kHeight, h}, 0);
    FluidConfig& fluid = *config.fluid;
    fluid.turbulence = Turbulence::none;
    fluid.density = kRho;
    fluid.kinematic_viscosity = kNu;
    fluid.top = WallFlow::no_slip;
    fluid.mean_velocity = u;
    BodyConfig cylinder;
    cylinder.name = "cylinder";
    cylinder.shape = BodyShape::of<shapes::Cylinder>();
    cylinder.axis = Axis::z;
    cylinder.centre = {kCentreX, h / 2};
    cylinder.radius = kDiameter / 2;
    cylinder.base = kCentreY - kDiameter / 2;
    config.bodies = {cylinder};
    return config;
  }

  /// Drag and lift coefficient.
  std::pair<double, double> coefficients() const {
    const Vec3& force = run.solver.body_loads()[0].force;
    const double unit = kRho * bulk * bulk * kDiameter / 2 * run.grid.lz;
    return {force.x / unit, force.y / unit};
  }
  /// Difference of the pressure with its driving part, linear from the fluid to the surface,
  /// between the first and the last point of the cylinder, over the density.
  double pressure_difference() const {
    const auto p = to_host(run.fluid.p);
    const double h = run.grid.dx;
    const double row = kCentreY / h - 0.5;
    const int j = static_cast<int>(std::floor(row));
    const auto at = [&](int i) { return p(i, j, 0) + (row - j) * (p(i, j + 1, 0) - p(i, j, 0)); };
    const auto on_surface = [&](double x, int side) {
      // Two cells whose rows are both in the fluid.
      const int i = static_cast<int>(std::lround(x / h - 0.5)) + side;
      const double distance = std::abs((i + 0.5) * h - x) / h;
      return at(i) + distance * (at(i) - at(i + side));
    };
    const double a = kDiameter / 2;
    return on_surface(kCentreX - a, -1) - on_surface(kCentreX + a, 1) +
           kRho * run.fluid.drive.x * kDiameter;
  }
  /// Length from the back of the cylinder to where u changes its sign in its middle.
  double recirculation() const {
    const auto u = to_host(run.fluid.u.x);
    const double h = run.grid.dx, row = kCentreY / h - 0.5;
    const int j = static_cast<int>(std::floor(row));
    const auto at = [&](int i) { return u(i, j, 0) + (row - j) * (u(i, j + 1, 0) - u(i, j, 0)); };
    int i = static_cast<int>(std::ceil((kCentreX + kDiameter / 2) / h)) + 1;
    while (i + 1 < run.grid.nx && at(i + 1) < 0) ++i;
    return (i + at(i) / (at(i) - at(i + 1))) * h - kCentreX - kDiameter / 2;
  }
};

struct Steady {
  double drag, lift, pressure, length;
};

Steady steady_flow(int n) {
  Benchmark flow(0.2, n);
  double before = 0, drag = 1;
  const int each = static_cast<int>(1 / flow.dt);
  for (int second = 0; second < 40 && std::abs(drag - before) > 1e-5 * drag; ++second) {
    before = drag;
    for (int s = 0; s < each; ++s) flow.advance();
    drag = flow.coefficients().first;
  }
  const auto [cd, cl] = flow.coefficients();
  const Steady s{cd, cl, flow.pressure_difference(), flow.recirculation()};
  std::printf("[ measured ] 2D-1, D / h = %d: Cd %.4f, Cl %.4f, dp %.4f, La %.4f\n", n, s.drag,
              s.lift, s.pressure, s.length);
  return s;
}

// Re = 20: drag 5.5795, lift 0.0106, pressure difference 0.1175, length of the recirculation 0.0842
// to 0.0852 m. Finer meshes: docs/validation.md.
TEST(CylinderInAChannel, AtReynolds20ItIsThatOfTheBenchmark) {
  const Steady flow = steady_flow(10);
  expect_relative("drag of a cylinder in a channel, Re 20", flow.drag, 5.5795, 0.01);
  expect_below("its lift: error over the drag", std::abs(flow.lift - 0.0106) / 5.5795, 0.001);
  expect_relative("its pressure difference", flow.pressure, 0.1175, 0.07);
  expect_relative("its recirculation", flow.length, 0.0847, 0.05);
}

struct Shedding {
  double drag = 0, lift = 0, strouhal = 0;  // largest, largest
};

/// Vortex shedding once the vortices are there, over the last ten or so periods.
Shedding shed_vortices(int n) {
  Benchmark flow(1, n);
  while (flow.run.fluid.time < 8) flow.advance();
  Shedding found;
  std::vector<double> rises;  // times at which the lift rises through zero
  double before = 0;
  while (flow.run.fluid.time < 11) {
    flow.advance();
    const auto [drag, lift] = flow.coefficients();
    found.drag = std::max(found.drag, drag);
    found.lift = std::max(found.lift, lift);
    if (before < 0 && lift >= 0)
      rises.push_back(flow.run.fluid.time - flow.dt * lift / (lift - before));
    before = lift;
  }
  if (rises.size() > 1)
    found.strouhal = kDiameter * static_cast<double>(rises.size() - 1) / (rises.back() - rises[0]);
  std::printf("[ measured ] 2D-2, D / h = %d: largest Cd %.4f, largest Cl %.4f, St %.4f\n", n,
              found.drag, found.lift, found.strouhal);
  return found;
}

// Re = 100: largest drag 3.22 to 3.24, largest lift 0.99 to 1.01, Strouhal number 0.295 to 0.305.
TEST(CylinderInAChannel, AtReynolds100ItShedsTheVorticesOfTheBenchmark) {
  const Shedding flow = shed_vortices(10);
  expect_relative("Strouhal number of a cylinder in a channel", flow.strouhal, 0.300, 0.03);
  expect_relative("its largest drag", flow.drag, 3.23, 0.03);
}

}  // namespace
}  // namespace barchan
