// Lift, torque and wall drag of the program on one grain, against closed forms.
#include "kernels/fluid/flow_sums.hpp"
#include "src/initial/initial_state.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/drag_reference.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using test::CoupledRun;

constexpr double kDiameter = 2e-4, kDensity = 2500, kMu = 1e-3;  // [m], [kg/m^3], [Pa s]
/// rho_p d^2/(60 mu): moment of inertia over Kirchhoff's pi mu d^3 [s].
constexpr double kSpinTime = kDensity * kDiameter * kDiameter / (60 * kMu);

/// A box of 4 x 4 x 4 mm in which these forces act and no other.
Config box(const ForceSwitches& forces) {
  Config c = test::water_box({8, 8, 8}, {4e-3, 4e-3, 4e-3});
  c.coupling.forces = forces;
  c.time.grain_step = 2.5e-6;
  return c;
}
constexpr ForceSwitches kNothing{.drag = false,
                                 .pressure_gradient = false,
                                 .stress = false,
                                 .added_mass = false,
                                 .buoyancy = false};
ForceSwitches only(bool ForceSwitches::*force) {
  ForceSwitches forces = kNothing;
  forces.*force = true;
  return forces;
}

// I dw/dt = -pi mu d^3 w: exp(-t/tau), tau = rho_p d^2/(60 mu).
TEST(FluidTorque, SpinsDownInStillWater) {
  InitialGrains grain;
  const Vec3 spin{100, -200, 300};  // Re_r = 15
  test::add_grain(grain, kDiameter, {2e-3, 2e-3, 2e-3}, {}, spin);
  CoupledRun run(box(only(&ForceSwitches::torque)), grain);
  run.advance(20);
  const Vec3 left = run.rows()[1].omega;
  const double expected = std::exp(-20 * 2.5e-4 / kSpinTime);
  test::expect_relative("spin left after 3 tau, x", left.x / spin.x, expected, 2e-3);
  test::expect_relative("spin left after 3 tau, y", left.y / spin.y, expected, 2e-3);
  test::expect_relative("spin left after 3 tau, z", left.z / spin.z, expected, 2e-3);
}

// Dennis, Singh & Ingham (1980) at Re_r = 1000 to 300: I dw/dt = -C_r (rho/2) a^5 w^2.
TEST(FluidTorque, SpinsDownFasterAtHighSpeed) {
  Config c = box(only(&ForceSwitches::torque));
  InitialGrains grain;
  const double d = 1e-3, start = 1000e-6 / (d * d);
  test::add_grain(grain, d, {2e-3, 2e-3, 2e-3}, {}, {0, 0, start});
  CoupledRun run(c, grain);
  const int steps = 80;
  run.advance(steps);
  double w = start;
  const double inertia = 0.1 * kDensity * test::volume_of(d) * d * d, h = 2.5e-6;
  for (int n = 0; n < 100 * steps; ++n) {
    const double re = d * d * w / 1e-6, c_r = 12.9 / std::sqrt(re) + 128.4 / re;
    w -= h * c_r * 500 * std::pow(d / 2, 5) * w * w / inertia;
  }
  test::expect_relative("fast spin left", run.rows()[1].omega.z / start, w / start, 2e-3);
}

/// Steady Couette flow u = shear y between the floor and a lid, and a grain in it.
Config couette(const ForceSwitches& forces, double shear) {
  Config c = box(forces);
  c.fluid->bottom = c.fluid->top = WallFlow::no_slip;
  c.fluid->top_velocity = shear * c.size[1];
  return c;
}
void set_shear(CoupledRun& run, double shear) {
  const test::HostGrid h(run.state.fluid->grid);
  test::set_field(run.state.fluid->u.x, run.state.fluid->grid,
                  [&](int, int j, int) { return shear * h.y(j); });
  run.fill_ghosts();
}

TEST(FluidTorque, SpinBecomesHalfTheVorticity) {
  const double shear = 256;
  InitialGrains grain;
  test::add_grain(grain, kDiameter, {2e-3, 1.7e-3, 2e-3});
  Config c = couette(only(&ForceSwitches::torque), shear);
  c.coupling.smoothing_length = 2e-3;  // the flow hardly has to go round the grain
  CoupledRun run(c, grain);
  set_shear(run, shear);
  run.advance(20);
  const double rise = 1 - std::exp(-20 * 2.5e-4 / kSpinTime);
  test::expect_relative("spin over half the vorticity, after 3 tau",
                        run.rows()[1].omega.z / (-shear / 2), rise, 2e-3);
  run.advance(100);
  test::expect_relative("spin over half the vorticity, at last",
                        run.rows()[1].omega.z / (-shear / 2), 1, 1e-4);
}

// The couple on the grains is not given to the fluid. As a stress it would be 3 (1 - alpha_f) mu
// |w/2 - omega| at a grain: at most 1.5 (1 - alpha_f) of the viscous stress mu |w| unless a contact
// turns the grain against the flow.
TEST(FluidTorque, WhatTheFluidIsSparedIsAPartOfTheViscousStress) {
  Config c = test::coupled_config();
  c.coupling.forces.torque = true;
  CoupledRun run(c, make_initial_state(c, {}));
  run.advance(200);
  const GrainState& grains = *run.state.grains;
  const test::HostGrid h(run.state.fluid->grid);
  const test::HostField alpha = test::to_host(run.state.fluid->alpha_f);
  const auto kin = host_copy(grains.kin);
  const auto omega_f = host_copy(grains.fluid.omega_f);
  double spared = 0, viscous = 0, solid = 0;
  for (int g = 0; g < grains.n; ++g) {
    const double s =
        1 - interpolate_cell(alpha.ref(), PointStencil(h.ref(), {0, c.size[2]}, kin(g).x));
    spared += 3 * s * norm(omega_f(g) - kin(g).omega);
    viscous += 2 * norm(omega_f(g));
    solid += s;
  }
  std::printf("[ measured ] solid fraction at the grains %.3f\n", solid / grains.n);
  test::expect_below("stress of the couples over the viscous stress, at the grains",
                     spared / viscous, 1.5 * solid / grains.n);
}

// --- A grain that lies on the floor of the paper's first mesh, in linear shear.

constexpr double kDx = 1.6e-3, kDz = 0.05 / 31.5;

CoupledRun on_the_floor(double shear, const ForceSwitches& forces) {
  Config c = test::water_box({8, 30, 8}, {8 * kDx, 0.025, 8 * kDz});
  c.fluid->first_cell_height = 2.625e-4;
  c.fluid->bottom = WallFlow::no_slip;
  c.coupling.smoothing_length = 6e-4;
  c.coupling.scheme =
      CouplingScheme::smoothed;  // the drag law then hardly sees the grain's own volume
  c.coupling.forces = forces;
  c.grains->frozen = true;
  InitialGrains grain;
  test::add_grain(grain, kDiameter, {3.3 * kDx, kDiameter / 2, 4.1 * kDz});
  CoupledRun run(c, grain);
  set_shear(run, shear);
  run.advance();
  return run;
}

// Zeng et al. (2009) at contact: eq. 19, and eq. 13 and 14 with delta = 0.
TEST(GrainOnFloor, LiftAndDragAreThoseOfLinearShear) {
  ForceSwitches forces;
  forces.lift = forces.wall_drag = true;
  for (const double shear : {1.0, 64.0, 256.0, 2000.0}) {
    CoupledRun run = on_the_floor(shear, forces);
    const double u = shear * kDiameter / 2, re = u * kDiameter / 1e-6;
    const double dynamic = std::numbers::pi / 8 * 1000 * kDiameter * kDiameter * u * u;
    const double c_l = 3.663 / std::pow(re * re + 0.1173, 0.22);
    const double c_d = 1.7005 * 24 / re * (1 + 0.104 * std::pow(re, 0.753));
    const std::string at = " at Re " + std::to_string(re).substr(0, 5);
    test::expect_relative("lift" + at, test::force_on_first(run, "force_lift").y, c_l * dynamic,
                          1e-6);
    // The grain itself fills 8e-4 of the volume around it, which adds 0.2 % (alpha_f^-2.65).
    test::expect_relative("drag" + at, test::force_on_first(run, "force_drag").x, c_d * dynamic,
                          5e-3);
    EXPECT_LT(std::abs(test::force_on_first(run, "force_lift").x), 1e-6 * c_l * dynamic);
  }
}

TEST(GrainOnFloor, HasNoLiftWithoutTheSwitch) {
  CoupledRun run = on_the_floor(256, {});
  EXPECT_TRUE(std::isnan(test::force_on_first(run, "force_lift").y)) << "there is no such array";
  const double alone = test::schiller_naumann_force(256 * kDiameter / 2, kDiameter);
  test::expect_relative("drag without the floor's part", test::force_on_first(run, "force_drag").x,
                        alone, 0.01);
}

/// Drag over its reference after half a second in which the grain slows the flow around it: Couette
/// flow between the floor and a lid ten diameters above, cells of `cell` [m] and the paper's first
/// row.
double drag_in_own_wake(double cell, CouplingScheme scheme, double reference) {
  const double shear = 256, length = 6.4e-3, height = 2e-3;
  const int n = static_cast<int>(std::lround(length / cell));
  Config c = test::water_box({n, 6, n}, {length, height, length});
  c.fluid->first_cell_height = 2.625e-4;
  c.fluid->bottom = c.fluid->top = WallFlow::no_slip;
  c.fluid->top_velocity = shear * height;
  c.coupling.smoothing_length = 6e-4;
  c.coupling.scheme = scheme;
  c.coupling.forces.wall_drag = true;
  c.grains->frozen = true;
  InitialGrains grain;
  test::add_grain(grain, kDiameter, {0.43 * length, kDiameter / 2, 0.52 * length});
  CoupledRun run(c, grain);
  set_shear(run, shear);
  run.advance(2000);
  return test::force_on_first(run, "force_drag").x / reference;
}

TEST(GrainOnFloor, FeelsTheFlowThatItSlows) {
  const double u = 256 * kDiameter / 2, re = u * kDiameter / 1e-6;
  const double known = 1.7005 * 24 / re * (1 + 0.104 * std::pow(re, 0.753)) * std::numbers::pi / 8 *
                       1000 * kDiameter * kDiameter * u * u;
  const auto check = [&](double cell, CouplingScheme scheme, double tolerance) {
    char claim[100];
    std::snprintf(claim, sizeof claim, "drag in its own wake, cells of %.1f mm, %s", 1e3 * cell,
                  scheme == CouplingScheme::layered ? "layered" : "smoothed");
    test::expect_relative(claim, drag_in_own_wake(cell, scheme, known), 1, tolerance);
  };
  check(1.6e-3, CouplingScheme::layered, 0.05);  // the paper's cells
  check(8e-4, CouplingScheme::layered, 0.1);
  check(4e-4, CouplingScheme::layered, 0.3);
  check(1.6e-3, CouplingScheme::smoothed, 0.03);
  check(8e-4, CouplingScheme::smoothed, 0.04);
  check(4e-4, CouplingScheme::smoothed, 0.06);
}

// --- What the grain gets the fluid loses. Lift along z, in a flow along x that varies along z:
// nothing else acts along z, so the momentum of both along z stays what it was, but for the share
// 1 - alpha_f of pressure gradient and stress that no grain gets here; smoothed, it is below 1e-4.

double momentum_along_z(const CoupledRun& run) {
  const FluidState& f = *run.state.fluid;
  const GrainKinematics grain = host_copy(run.state.grains->kin)(0);
  const Grid grid = f.grid;
  const ConstFieldRef w = f.u.z, alpha = f.alpha_f;
  const double fluid = sum_each_cell(
      "test: momentum along z", grid, KOKKOS_LAMBDA(int i, int j, int k) {
        return cell_to_zface(alpha, i, j, k) * w(i, j, k) * grid.cell_volume(j);
      });
  return 1000 * fluid + grain.m * grain.u.z;
}

/// Change of the momentum of both along z over 40 steps, over the impulse of the lift.
double lost_along_z(const Config& c, double& impulse, double& of_grain) {
  InitialGrains grain;
  test::add_grain(grain, kDiameter, {2.1e-3, 1.8e-3, 1.3e-3}, {0.1, 0, 0});
  CoupledRun run(c, grain);
  const test::HostGrid h(run.state.fluid->grid);
  test::set_field(run.state.fluid->u.x, run.state.fluid->grid, [&](int, int, int k) {
    return 0.2 * std::sin(2 * std::numbers::pi * h.z(k) / 4e-3);
  });
  run.fill_ghosts();
  const double before = momentum_along_z(run);
  impulse = 0;
  for (int n = 0; n < 40; ++n) {
    run.advance();
    impulse += 2.5e-4 * test::force_on_first(run, "force_lift").z;
  }
  const GrainKinematics after = host_copy(run.state.grains->kin)(0);
  of_grain = after.m * after.u.z;
  return std::abs((momentum_along_z(run) - before) / impulse);
}

TEST(Lift, IsTakenFromTheFluid) {
  Config c = box(only(&ForceSwitches::lift));
  c.coupling.smoothing_length = 2e-3;
  c.coupling.scheme = CouplingScheme::smoothed;
  double impulse = 0, of_grain = 0;
  test::expect_below("momentum of both that lift changes, smoothed",
                     lost_along_z(c, impulse, of_grain), 1e-4);
  test::expect_relative("momentum of the grain along z, impulse of the lift", of_grain, impulse,
                        1e-9);
  // Layered, the share of the stress is not smoothed: here the grain gets it.
  c.coupling.scheme = CouplingScheme::layered;
  c.coupling.forces.stress = c.coupling.forces.pressure_gradient = true;
  test::expect_below("momentum of both that lift changes, layered",
                     lost_along_z(c, impulse, of_grain), 1e-4);
}

}  // namespace
}  // namespace barchan
