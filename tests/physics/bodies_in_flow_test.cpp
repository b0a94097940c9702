// Bodies at rest in laminar flows: where their walls are, and what the flow does to them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "kernels/fluid/body_faces.hpp"
#include "src/bodies/make_bodies.hpp"
#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace test;
using std::numbers::pi;

constexpr double kTolerance = 1e-10;  // of the pressure

BodyConfig body_of(BodyShape shape, std::array<double, 2> centre) {
  BodyConfig body;
  body.name = "body";
  body.shape = shape;
  body.centre = centre;
  return body;
}

BodyConfig step_over_everything(double height) {
  BodyConfig body = body_of(BodyShape::of<shapes::Box>(), {0, 0});
  body.height = height;
  return body;
}

/// Momentum of all fluid along an axis [kg m/s].
Vec3 momentum(const FlowRun& run) {
  const auto u = to_host(run.fluid.u.x), v = to_host(run.fluid.u.y), w = to_host(run.fluid.u.z);
  const double rho = run.config.fluid->density, area = run.grid.dx * run.grid.dz;
  Vec3 sum;
  for_owned_cells(run.grid, [&](int i, int j, int k) {
    sum += {rho * area * run.h.dy(j) * u(i, j, k), rho * area * run.h.dy_centre(j) * v(i, j, k),
            rho * area * run.h.dy(j) * w(i, j, k)};
  });
  return sum;
}

/// Runs until the flow is steady, on cells of this size [m].
void run_until_steady(FlowRun& run, double cell) {
  const double nu = run.config.fluid->kinematic_viscosity;
  const double dt = 0.08 * cell * cell / nu;  // explicit diffusion allows 1/12
  for (double before = -1, now = 0; !(std::abs(now - before) <= 1e-5 * now) && !std::isnan(now);) {
    before = now;
    for (int s = 0; s < 50; ++s) run.advance(dt);
    now = bulk_velocity(run.fluid);
  }
}

/// 8 rows of faces, of which three are in the floor; theta of a cell are below the fourth.
FlowRun over_a_box(double theta, const PlaneVelocity& bulk, double gradient) {
  const double height = 0.02, h = height / 8;
  Config config = laminar({3, 8, 3}, {0.01, height, 0.01}, 1e-3, kTolerance);
  config.bodies = {step_over_everything((3.5 - theta) * h)};
  if (gradient > 0) config.fluid->pressure_gradient = gradient;
  if (bulk.z != 0) config.fluid->schedule = {{.time = 0, .velocity = bulk}};
  FlowRun run(config);
  run.start_uniform(0);
  for (int s = 0; s < 900; ++s) run.advance(1.4e-3);
  return run;
}

// The floor is the top of a box, anywhere within a cell. Flow down a plane: by the balance of every
// row of faces the discrete solution is the parabola and theta (1 - theta) h^2 G / 2 nu, G the
// force per mass.
TEST(BodiesInFlow, OverABoxTheFlowIsPoiseuillesWhereverItsTopIs) {
  const double force = 2, height = 0.02, h = height / 8;  // G / nu
  for (const double theta : {0.05, 0.3, 0.5, 0.8, 1.0}) {
    SCOPED_TRACE(theta);
    const FlowRun run = over_a_box(theta, {}, 1000 * 1e-3 * force);
    const double floor = (3.5 - theta) * h, depth = height - floor;
    const double shift = theta * (1 - theta) * h * h * force / 2;
    const auto u = to_host(run.fluid.u.x);
    double error = 0;
    for (int j = 0; j < 8; ++j) {
      const double s = run.h.y(j) - floor;
      const double exact = j < 3 ? 0 : force * (depth * s - s * s / 2) + shift;
      error = std::max(error, std::abs(u(1, j, 2) - exact));
    }
    EXPECT_LT(error / (force * depth * depth / 2), 1e-6);
    const double push = 1000 * 1e-3 * force * height * 1e-4;
    EXPECT_NEAR(run.solver.body_loads()[0].force.x / push, 1, 1e-6)
        << "all that drives the flow pushes the floor";
  }
}

// Poiseuille flow along z, where the drive acts on the predicted velocity.
TEST(BodiesInFlow, AlsoAlongZ) {
  const double h = 0.02 / 8, floor = 3.2 * h, depth = 0.02 - floor;
  const FlowRun run = over_a_box(0.3, {0, 0.01}, 0);
  const double force = run.fluid.drive.z / 1e-3;
  const auto w = to_host(run.fluid.u.z);
  double sum = 0;
  for (int j = 0; j < 8; ++j) {
    const double s = run.h.y(j) - floor;
    const double exact = force * (depth * s - s * s / 2 + 0.3 * 0.7 * h * h / 2);
    EXPECT_NEAR(w(1, j, 2), j < 3 ? 0 : exact, 1e-6 * force * depth * depth);
    sum += w(1, j, 2) / 8;
  }
  EXPECT_NEAR(sum, 0.01, 1e-8) << "the bulk velocity is that of the whole section";
}

// Stretched rows: the widths of cells enter. The slope of a flow between a wall that moves and one
// at rest is the same everywhere, and so is nothing of the error of rows of unequal height.
TEST(BodiesInFlow, CouetteFlowIsExactOnStretchedRows) {
  const double nu = 1e-3, height = 0.02, speed = 0.1;
  for (const double floor : {0.0071, 0.0074, 0.0077}) {
    Config config = laminar({3, 16, 3}, {0.01, height, 0.01}, nu, kTolerance);
    config.fluid->first_cell_height = 0.0008;
    config.fluid->top = WallFlow::no_slip;
    config.fluid->top_velocity = speed;
    config.bodies = {step_over_everything(floor)};
    FlowRun run(config);
    run.start_uniform(0);
    for (int s = 0; s < 2000; ++s) run.advance(2e-4);
    const auto u = to_host(run.fluid.u.x);
    double error = 0;
    for (int j = 0; j < 16; ++j) {
      const double exact = std::max(0., run.h.y(j) - floor) / (height - floor) * speed;
      error = std::max(error, std::abs(u(1, j, 2) - exact));
    }
    EXPECT_LT(error, 1e-8 * speed);
    const double stress = 1000 * nu * speed / (height - floor);
    EXPECT_NEAR(run.solver.body_loads()[0].force.x / (stress * 1e-4), 1, 1e-8);
  }
}

/// Rod in the middle of a square of this size, shifted by `shift` across its axis.
BodyConfig rod_along(Axis axis, double radius, double size, double shift) {
  const double across = size / 2 + shift;
  BodyConfig rod = body_of(BodyShape::of<shapes::Cylinder>(),
                           axis == Axis::x ? std::array{0.0, across} : std::array{across, 0.0});
  rod.axis = axis;
  rod.radius = radius;
  rod.base = size / 2 - radius;
  return rod;
}

/// A rod of volume fraction c in the middle of a square box of n x n cells; shifted along z by a
/// part of a cell. Flow along it until it is steady. Returns K / a^2.
double measured_permeability_along(double c, int n, double shift) {
  const double size = 0.01, nu = 1e-3, a = size * std::sqrt(c / pi);
  Config config = laminar({2, n, n}, {2 * size / n, size, size}, nu, kTolerance);
  config.fluid->bottom = WallFlow::free_slip;
  config.fluid->pressure_gradient = 1;
  config.bodies = {rod_along(Axis::x, a, size, shift * size / n)};
  FlowRun run(config);
  run.start_uniform(0);
  run_until_steady(run, size / n);
  return bulk_velocity(run.fluid) * 1000 * nu / (a * a);
}

// u = A ln(r / a) - (r^2 - a^2) / 4 + sum B_n (r^4n - a^8n r^-4n) cos 4 n phi vanishes on the rod;
// with no slope on the sides of the square its mean is K / a^2 = 0.2351908 for c = 0.3. The first
// terms of Drummond & Tahir, Int. J. Multiphase Flow 10, 515 (1984), (-ln c - 1.476 + 2 c - c^2 /
// 2) / 4 c, are 0.2355.
TEST(BodiesInFlow, AlongASquareArrayOfRodsItIsOfSecondOrder) {
  double worst[2] = {};
  for (const int fine : {0, 1}) {
    for (const double shift : {0.0, 0.37}) {
      const double k = measured_permeability_along(0.3, fine ? 24 : 12, shift);
      worst[fine] = std::max(worst[fine], std::abs(k / 0.2351908 - 1));
    }
  }
  expect_below("flow along rods, error of the permeability, 15 cells to a diameter", worst[1],
               0.01);
  expect_order("flow along rods, permeability", worst[0], worst[1], 2, 0.3);
}

/// A cylinder along z of volume fraction c in the middle of a square box, with Stokes flow along x
/// through the square array of them. Drag over mu U.
double measured_drag_across(double c, int n, double shift) {
  const double size = 0.01, nu = 1e-3, a = size * std::sqrt(c / pi);
  Config config = laminar({n, n, 1}, {size, size, size / n}, nu, kTolerance);
  config.fluid->bottom = WallFlow::free_slip;
  config.fluid->pressure_gradient = 1e-2;
  config.bodies = {rod_along(Axis::z, a, size, shift * size / n)};
  FlowRun run(config);
  run.start_uniform(0);
  run_until_steady(run, size / n);
  const double drag = run.solver.body_loads()[0].force.x / run.grid.lz;
  EXPECT_NEAR(drag / (1e-2 * size * size), 1, 1e-3) << "all of the drive, once the flow is steady";
  return drag / (1000 * nu * bulk_velocity(run.fluid));
}

// Sangani & Acrivos, Int. J. Multiphase Flow 8, 193 (1982), table 1: F / (mu U) of square arrays is
// 102.90 at c = 0.3. Fluxes end at whole faces, so the error of the finer mesh is not always less.
TEST(BodiesInFlow, AcrossASquareArrayOfCylindersItIsSanganiAndAcrivos) {
  for (const double shift : {0.0, 0.37}) {
    const double drag = measured_drag_across(0.3, 24, shift);
    expect_relative("drag across cylinders, 15 cells to a diameter", drag, 102.90, 0.015);
  }
}

/// Force on the floor, as the stencil of this velocity has it [N]. The eddy viscosity on the floor
/// is zero.
Vec3 floor_stress(const FlowRun& run) {
  const auto u = to_host(run.fluid.u.x), w = to_host(run.fluid.u.z);
  const FluidConfig& fluid = *run.config.fluid;
  const double per_speed =
      fluid.density * fluid.kinematic_viscosity * run.grid.dx * run.grid.dz / (run.h.dy(0) / 2);
  Vec3 sum;
  for (int k = 0; k < run.grid.nz; ++k)
    for (int i = 0; i < run.grid.nx; ++i) sum += per_speed * Vec3{u(i, 0, k), 0, w(i, 0, k)};
  return sum;
}

// O'Neill, Chem. Eng. Sci. 23, 1293 (1968): a sphere that touches a wall in slow shear has 1.7009
// of Stokes' drag and 0.944 of his torque. Here r is 4 cells, the lid 4 r above and the next
// spheres 8 r away, which adds some 3 %: with 6 r and 12 r the drag is 1 % above his
// (docs/validation.md).
TEST(BodiesInFlow, ASphereOnTheFloorHasONeillsDragAndTorque) {
  const int cells = 4;
  const double r = 1e-3, nu = 1e-5, rate = 0.1, h = r / cells;
  Config config = laminar({8 * cells, 4 * cells, 8 * cells}, {8 * r, 4 * r, 8 * r}, nu, 1e-6);
  config.fluid->top = WallFlow::no_slip;
  config.fluid->top_velocity = rate * 4 * r;
  config.bodies = {body_of(BodyShape::of<shapes::Sphere>(), {4 * r, 4 * r})};
  config.bodies[0].radius = r;
  FlowRun run(config);
  run.start([&](int, int j, int) { return rate * run.h.y(j); });
  const double dt = 0.07 * h * h / nu, time = 12 * r * r / nu;
  for (int s = 0; s * dt < time; ++s) run.advance(dt);
  const BodyLoad load = run.solver.body_loads()[0];
  const double mu = 1000 * nu, drag = 1.7009 * 6 * pi * mu * r * r * rate;
  const double torque = 0.944 * 4 * pi * mu * r * r * r * rate + drag * r;
  expect_below("drag of a sphere on the floor: error", std::abs(load.force.x / drag - 1), 0.05);
  expect_below("torque about its lowest point: error", std::abs(-load.torque.z / torque - 1), 0.05);
}

// Two bodies in an oblique flow: bodies and floor take the drive less the growth of the fluid's
// momentum, to round-off.
TEST(BodiesInFlow, MomentumThatTheWaterLosesIsOnBodiesAndFloor) {
  Config config = laminar({24, 12, 16}, {0.048, 0.024, 0.032}, 1e-5, kTolerance);
  config.fluid->first_cell_height = 0.0012;
  config.fluid->turbulence = Turbulence::wale;
  config.fluid->schedule = {{.time = 0, .velocity = {0.2, 0.05}}};
  BodyConfig sphere = body_of(BodyShape::of<shapes::Sphere>(), {0.013, 0.009}),
             post = body_of(BodyShape::of<shapes::Cylinder>(), {0.033, 0.021});
  sphere.radius = 0.0053, sphere.base = 0.004;
  post.name = "post";
  post.radius = 0.0047, post.height = 0.0132;
  config.bodies = {sphere, post};
  FlowRun run(config);
  run.start([](int i, int j, int k) { return 0.2 + 0.02 * std::sin(i + 2 * j + 3 * k); });
  run.solver.flow_around_bodies(run.fluid);
  const double dt = 1e-3, mass = 1000 * run.grid.lx * run.grid.ly * run.grid.lz;
  double worst = 0, least = 1e9;
  Vec3 floor_before;
  for (int step = 0; step < 10; ++step) {
    const Vec3 before = momentum(run);
    const Vec3 floor = floor_stress(run);
    run.advance(dt);
    const Vec3 after = momentum(run);
    const Vec3 mean = step == 0 ? floor : 1.5 * floor + (-0.5) * floor_before;
    floor_before = floor;
    Vec3 on_bodies;
    for (const BodyLoad& load : run.solver.body_loads()) on_bodies += load.force;
    const Vec3 lost =
        (1 / dt) * (before - after) + mass * Vec3{run.fluid.drive.x, 0, run.fluid.drive.z} - mean;
    worst = std::max({worst, std::abs(lost.x - on_bodies.x), std::abs(lost.z - on_bodies.z)});
    least = std::min(least, norm(on_bodies));
    EXPECT_LT(run.report.continuity_residual, 1e-9);
  }
  expect_below("force on bodies against the momentum that is lost, relative", worst / least, 1e-10);
}

// Rows grow: a face across y has the fluid from the middle of the row below to that above.
TEST(BodiesInFlow, FacesHaveTheVolumeOfTheirMomentum) {
  Config config = laminar({4, 9, 5}, {0.04, 0.09, 0.05}, 1e-5);
  config.fluid->first_cell_height = 0.004;
  const Grid grid = make_grid(config);
  const test::HostGrid rows(grid);
  const GridRef on_host = rows.ref();
  for (int j = 1; j < 9; ++j) {
    const BodyFace across_x{.j = j, .axis = 0}, across_y{.j = j, .axis = 1},
        across_z{.j = j, .axis = 2};
    const double half_below = rows.dy(j - 1) / 2, half_above = rows.dy(j) / 2;
    EXPECT_NEAR(across_y.volume(on_host), 1e-4 * (half_below + half_above), 1e-18);
    EXPECT_NEAR(across_x.volume(on_host), 1e-4 * rows.dy(j), 1e-18);
    EXPECT_NEAR(across_z.volume(on_host), 1e-4 * rows.dy(j), 1e-18);
    EXPECT_GT(half_above, half_below);
  }
}

// Turned by a right angle, a case has the turned force.
TEST(BodiesInFlow, ATurnedCaseHasTurnedLoads) {
  const auto loads_of = [](bool turned) {
    std::array<int, 3> cells{20, 10, 14};
    std::array<double, 3> size{0.04, 0.02, 0.028};
    BodyConfig box = body_of(BodyShape::of<shapes::Box>(), {0.0151, 0.0123});
    box.size = {0.0077, 0.0055}, box.height = 0.0083;
    if (turned) {
      std::swap(cells[0], cells[2]), std::swap(size[0], size[2]);
      std::swap(box.centre[0], box.centre[1]), std::swap(box.size[0], box.size[1]);
    }
    Config config = laminar(cells, size, 1e-5, kTolerance);
    const PlaneVelocity bulk{turned ? 0 : 0.2, turned ? 0.2 : 0};
    config.fluid->schedule = {{.time = 0, .velocity = {0.02, 0.02}},
                              {.velocity = bulk, .ramp = 0.02}};
    config.fluid->schedule[1].time = 1e-9;
    config.bodies = {box};
    FlowRun run(config);
    run.start_uniform(0);
    for (int s = 0; s < 30; ++s) run.advance(1e-3);
    return run.solver.body_loads()[0];
  };
  const BodyLoad along = loads_of(false), across = loads_of(true);
  const double size = norm(along.force), arm = norm(along.torque);
  EXPECT_NEAR(across.force.z, along.force.x, 1e-7 * size);
  EXPECT_NEAR(across.force.x, along.force.z, 1e-7 * size);
  EXPECT_NEAR(across.force.y, along.force.y, 1e-7 * size);
  // A mirror image: torques change their sign.
  EXPECT_NEAR(across.torque.z, -along.torque.x, 1e-7 * arm);
  EXPECT_NEAR(across.torque.x, -along.torque.z, 1e-7 * arm);
  EXPECT_NEAR(across.torque.y, -along.torque.y, 1e-7 * arm);
  EXPECT_LT(along.torque.z, 0) << "the flow turns the post over, forwards";
}

TEST(BodiesInFlow, NothingFlowsInABodyAndAsMuchThroughEverySection) {
  Config config = laminar({16, 8, 12}, {0.04, 0.025, 0.03}, 1e-5, kTolerance);
  config.fluid->mean_velocity = 0.28;
  BodyConfig half = body_of(BodyShape::of<shapes::HalfSphere>(), {0.0171, 0.0144});
  half.radius = 0.0097;
  config.bodies = {half};
  FlowRun run(config);
  run.start_uniform(0.28);
  run.solver.flow_around_bodies(run.fluid);
  EXPECT_NEAR(bulk_velocity(run.fluid), 0.28, 1e-12);
  const Bodies bodies = make_bodies(config.bodies, config.size);
  const auto check = [&] {
    const auto u = to_host(run.fluid.u.x), v = to_host(run.fluid.u.y), w = to_host(run.fluid.u.z);
    std::vector<double> section(16);
    int closed = 0;
    for_owned_cells(run.grid, [&](int i, int j, int k) {
      section[static_cast<std::size_t>(i)] += u(i, j, k) * run.h.dy(j);
      const double of_axis[] = {u(i, j, k), v(i, j, k), w(i, j, k)};
      for (int axis = 0; axis < 3; ++axis) {
        if (bodies.nearest(face_middle(run.h, axis, i, j, k)).surface.distance > 0) continue;
        ++closed;
        EXPECT_EQ(of_axis[axis], 0);
      }
    });
    EXPECT_GT(closed, 100);
    for (const double flow : section) EXPECT_NEAR(flow / section[0], 1, 1e-7);
  };
  check();
  for (int s = 1; s <= 20; ++s) {
    run.advance(5e-4);
    EXPECT_LT(run.report.continuity_residual, 1e-9);
    EXPECT_LT(run.report.courant, 1);
    EXPECT_NEAR(run.report.bulk_velocity.x, bulk_velocity(run.fluid), 1e-14);
  }
  EXPECT_NEAR(run.report.bulk_velocity.x / 0.28, 1, 1e-3);
  check();
}

// A grain that leaves gives back its volume, which nothing can fill in a periodic box of fluid: the
// sum of the pressure's source is not zero. No pressure answers the part in closed cells.
TEST(BodiesInFlow, AStepInWhichAGrainLeavesHasAPressure) {
  Config config = laminar({16, 8, 12}, {0.04, 0.025, 0.03}, 1e-5, kTolerance);
  config.fluid->mean_velocity = 0.28;
  config.bodies = {body_of(BodyShape::of<shapes::HalfSphere>(), {0.0171, 0.0144})};
  config.bodies[0].radius = 0.0097;
  FlowRun run(config, Fraction::variable);
  run.start_uniform(0.28);
  run.solver.flow_around_bodies(run.fluid);
  run.advance(5e-4);
  const int usual = run.report.pressure_iterations;
  set_field(run.fluid.alpha_f_previous, run.grid,
            [](int i, int j, int k) { return i == 2 && j == 1 && k == 2 ? 0.99 : 1.; });
  run.advance(5e-4);
  EXPECT_LT(run.report.pressure_residual, config.solver.pressure_tolerance);
  EXPECT_LT(run.report.pressure_iterations, 2 * usual);
  EXPECT_LT(run.report.courant, 1);
}

}  // namespace
}  // namespace barchan
