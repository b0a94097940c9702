// A cylinder in a uniform current, Re = 40: steady, with two eddies behind it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr double kDiameter = 0.01, kSpeed = 0.1, kNu = kSpeed * kDiameter / 40;
constexpr double kCentre = 30 * kDiameter, kLength = 60 * kDiameter, kHeight = 60 * kDiameter;
constexpr double kInlet = kDiameter;  // where the current is held

/// The upper half: the lowest plane is one of symmetry, so is the highest. `n` cells to a diameter
/// up to 1.5 diameters, then rows grow.
FlowRun upper_half(int n) {
  const double h = kDiameter / n;
  Config config = laminar({60 * n, 6 * n, 1}, {kLength, kHeight, h}, kNu, 1e-5);
  config.fluid->first_cell_height = h;
  config.fluid->uniform_height = 1.5 * kDiameter;
  config.fluid->bottom = WallFlow::free_slip;
  config.fluid->mean_velocity = kSpeed;
  BodyConfig cylinder;
  cylinder.name = "cylinder";
  cylinder.shape = BodyShape::of<shapes::Cylinder>();
  cylinder.axis = Axis::z;
  cylinder.centre = {kCentre, h / 2};
  cylinder.radius = kDiameter / 2;
  cylinder.base = -kDiameter / 2;
  config.bodies = {cylinder};
  return FlowRun(config);
}

struct Steady {
  double drag = 0, length = 0;  // coefficient; of the eddies, in diameters
};

double drag_of(const FlowRun& run) {  // the half cylinder has half of it
  return 2 * run.solver.body_loads()[0].force.x /
         (1000 * kSpeed * kSpeed * kDiameter / 2 * run.grid.lz);
}

/// Length from the back of the cylinder to where the flow beside the plane of symmetry turns.
double length_of_eddies(const FlowRun& run) {
  const auto u = to_host(run.fluid.u.x);
  const double h = run.grid.dx;
  int i = static_cast<int>(std::ceil((kCentre + kDiameter / 2) / h)) + 1;
  while (i + 1 < run.grid.nx && u(i + 1, 0, 0) < 0) ++i;
  const double x = (i + u(i, 0, 0) / (u(i, 0, 0) - u(i + 1, 0, 0))) * h;
  return (x - kCentre) / kDiameter - 0.5;
}

Steady steady_flow(int n) {
  FlowRun run = upper_half(n);
  run.start_uniform(kSpeed);
  run.solver.flow_around_bodies(run.fluid);
  const double h = run.grid.dx, dt = std::min(0.25 * h / kSpeed, 0.08 * h * h / kNu);
  const int held = static_cast<int>(std::lround(kInlet / h));
  const int each = static_cast<int>(5 * kDiameter / kSpeed / dt);
  double before = 0, length = 1;
  const auto changes = [&] { return std::abs(length - before) / length; };
  for (int part = 0; part < 20 && changes() > 5e-4; ++part) {
    before = length;
    for (int s = 0; s < each; ++s) {
      run.advance(dt);
      run.hold(run.fluid.u.x, held, [](int) { return kSpeed; });
      run.hold(run.fluid.u.y, held, [](int) { return 0.; });
      run.solver.fill_ghosts(run.fluid);
    }
    length = length_of_eddies(run);
  }
  EXPECT_LT(changes(), 5e-4) << "not steady";
  const Steady s{drag_of(run), length};
  std::printf("[ measured ] Re 40, D / h = %d: Cd %.4f, eddies %.4f D, after %.0f D/U\n", n, s.drag,
              s.length, run.fluid.time * kSpeed / kDiameter);
  return s;
}

// Dennis & Chang, J. Fluid Mech. 42, 471 (1970): drag 1.522, eddies 2.345 D. Fornberg, J. Fluid
// Mech. 98, 819 (1980): 1.498, 2.24 D. Coutanceau & Bouard, J. Fluid Mech. 79, 231 (1977),
// measured 2.13 D.
TEST(CylinderInOpenWater, AtReynolds40HasThePublishedDragAndEddies) {
  const Steady flow = steady_flow(10);
  expect_relative("drag of a cylinder in a current, Re 40", flow.drag, 1.51, 0.04);
  expect_relative("its eddies, in diameters", flow.length, 2.24, 0.07);
}

}  // namespace
}  // namespace barchan
