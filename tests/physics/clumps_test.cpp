// Rigid clumps of spheres through list, contact law and integrator, against the mechanics of rigid
// bodies.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/coupling/shape_drag.hpp"
#include "src/grains/named_clumps.hpp"
#include "tests/support/clumps.hpp"
#include "tests/support/coupling_schemes.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/packing.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr Real kD = 2e-4;  // [m]

/// Velocity [m/s] at which a grain of 2500 kg/m^3 of this form sinks in water, by bisection.
Real terminal_velocity(Real d, const GrainForm& form) {
  const Real weight = kPi / 6 * d * d * d * 1500 * 9.81;
  Real low = 0, high = 1;
  for (int n = 0; n < 60; ++n) {
    const Real w = (low + high) / 2;
    const LocalFlow f{.alpha_f = 1, .rho_f = 1000, .mu_f = 1e-3, .slip = w, .d_p = d};
    (SchillerNaumann{}(f)*ShapeFactor{}(f, form) * w < weight ? low : high) = w;
  }
  return low;
}

/// Largest relative error of the energy of a body that tumbles without contacts for 2 ms.
Real energy_error(int steps) {
  const Config c = clump_config(crooked());
  InitialGrains grains;
  add_turned(grains, kD, {5e-3, 5e-3, 5e-3}, {0.5, 0.5, -0.5, 0.5}, {0.3, 0, 0},
             {2000, 300, -2500});
  ClumpBench bench(c, grains);
  const ClumpSums before = sums_of(bench.state);
  Real error = 0;
  for (int n = 0; n < steps; n += steps / 50) {
    bench.advance(steps / 50, 2e-3 / steps);
    const ClumpSums now = sums_of(bench.state);
    error = std::max(error, std::abs(now.energy / before.energy - 1));
    EXPECT_EQ(norm(bench.clumps()[0].j - ClumpBench(c, grains).clumps()[0].j), 0);
  }
  // 2 ms at 0.3 m/s, and spheres that stay where the orientation says.
  const ClumpMotion at = bench.clumps()[0];
  EXPECT_NEAR(at.x.x, 5e-3 + 6e-4, 1e-15);
  const ClumpShape shape = clump_shape(crooked());
  for (int k = 0; k < 3; ++k) {
    const Vec3 arm = at.d * rotate(at.q, shape.spheres[static_cast<std::size_t>(k)].centre);
    EXPECT_NEAR(norm(bench.grain(id_of_member(1, k)).x - at.x - arm), 0, 1e-17);
  }
  return error;
}

/// The angular momentum keeps its bits; the energy has the error of second order of the splitting.
TEST(Clumps, FreeBodyKeepsItsAngularMomentumAndEnergy) {
  const Real coarse = energy_error(500), fine = energy_error(1000);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(coarse, 1e-8);
  EXPECT_NEAR(coarse / fine, 4, 0.1);
}

/// A dimer that meets a wall without friction or loss: the impulse P acts on its lower sphere, the
/// speed of the contact is turned round, P = 2 v / (1/m + a^2/I). Tolerance: it turns on during the
/// impact, by 1e-3 here.
TEST(Clumps, DimerMeetsAWallAsARigidBody) {
  for (const Real tilt : {0.0, 0.3, 0.9}) {
    Config c = clump_config(NamedClump::dimer);
    c.grains->material = c.grains->wall =
        Material{.youngs_modulus = 1e10, .restitution = 1, .sliding_friction = 0};
    const ClumpShape shape = clump_shape(named_clump("dimer"));
    const Real half = norm(shape.spheres[0].centre) * kD, r = shape.spheres[0].radius * kD, v = 0.1;
    // Along y when upright; tilted towards x, so that the lower sphere is at -x.
    const Real from_axis = std::numbers::pi_v<Real> / 2 - tilt;
    const Real a = half * std::cos(from_axis), height = half * std::sin(from_axis) + r;
    InitialGrains grains;
    add_turned(grains, kD, {5e-3, height + 1e-6, 5e-3}, rotation_about({0, 0, 1}, from_axis),
               {0, -v, 0});
    ClumpBench bench(c, grains);
    const ClumpSums before = sums_of(bench.state);
    const ClumpMotion start = bench.clumps()[0];
    const Real inertia = shape.inertia.z * start.m * kD * kD;
    const Real dt = 2e-10;
    bool touched = false;
    for (int n = 0; n < 400000; ++n) {
      bench.advance(1, dt);
      const bool touches =
          norm(bench.contact_force(1)) + norm(bench.contact_force(id_of_member(1, 1))) > 0;
      if (touched && !touches) break;
      touched = touched || touches;
    }
    ASSERT_TRUE(touched);
    const ClumpMotion after = bench.clumps()[0];
    const Real impulse = 2 * v / (1 / start.m + a * a / inertia);
    EXPECT_NEAR(after.u.y, -v + impulse / start.m, 2e-3 * v) << tilt;
    EXPECT_NEAR(after.j.z, -a * impulse, 2e-3 * (a + 1e-3 * half) * impulse) << tilt;
    EXPECT_NEAR(after.u.x, 0, 1e-12 * v);
    // The energy comes back to the order of the step, and J + r x m v about the contact stays.
    EXPECT_NEAR(sums_of(bench.state).energy / before.energy, 1, 1e-4) << tilt;
    const Real about_contact = after.j.z + a * start.m * (after.u.y + v);
    EXPECT_NEAR(about_contact, 0, 2e-3 * half * start.m * v) << tilt;
  }
}

/// Clumps that meet with friction, loss and several contacts at once act on each other by forces in
/// the same points.
TEST(Clumps, CollisionsKeepMomentumAndAngularMomentum) {
  Config c = clump_config(NamedClump::cube);
  c.grains->material.restitution = 0.5;
  InitialGrains grains;
  add_turned(grains, kD, {5e-3, 5e-3, 5e-3}, rotation_about({0, 0, 1}, 0.2), {1, 0, 0},
             {300, 0, 50});
  add_turned(grains, 1.3 * kD, {5e-3 + 2.0 * kD, 5.02e-3, 5.03e-3},
             rotation_about({0.6, 0, 0.8}, 1), {-1, 0.1, 0}, {0, -200, 0});
  ClumpBench bench(c, grains);
  const ClumpSums before = sums_of(bench.state);
  bench.advance(400, 1e-6);
  const ClumpSums after = sums_of(bench.state);
  EXPECT_LT(after.energy, 0.9 * before.energy);  // they met
  const Real p = bench.clumps()[0].m, j = p * 5e-3;
  // Each step rounds sums as large as these.
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-13 * p);
  EXPECT_LT(norm(after.angular - before.angular), 1e-13 * j);
}

/// Spheres that a case with clumps moves as clumps of one go as spheres do: the same scheme with
/// other roundings, which contacts enlarge.
TEST(Clumps, SpheresAmongClumpsMoveAsSpheres) {
  Config c = grain_config();
  c.size = {3e-3, 5e-3, 3e-3};
  c.grains->kinds.resize(2);
  c.grains->kinds[0].name = "one", c.grains->kinds[1].name = "other";
  InitialGrains grains = lattice_packing(300, c.size, 0.3);
  for (Vec3& omega : grains.omega) omega = {50, -20, 10};
  GrainBench spheres(c, grains);
  c.grains->kinds[1].shape = {.shape = GrainShape::clump, .clump = NamedClump::dimer};
  ClumpBench clumps(c, grains);
  ASSERT_GT(clumps.state.clump.size(), 0u);
  for (GrainBench* bench : {&spheres, static_cast<GrainBench*>(&clumps)}) {
    set_weight(bench->state, {0, -9.81, 0});
    bench->advance(300, 1e-6);
  }
  EXPECT_GT(spheres.solver.contacts(spheres.state).n_contacts, 20);
  const auto a = rows_by_id(spheres.state), b = rows_by_id(clumps.state);
  for (std::size_t g = 1; g < a.size(); ++g) {
    EXPECT_NEAR(norm(a[g].x - b[g].x), 0, 1e-15) << g;
    EXPECT_NEAR(norm(a[g].u - b[g].u), 0, 1e-10) << g;
    EXPECT_NEAR(norm(a[g].omega - b[g].omega), 0, 1e-6) << g;
  }
}

/// Two cubes that meet across a seam go as two that meet in the middle of the box.
TEST(Clumps, ASeamIsNowhere) {
  Config c = clump_config(NamedClump::cube);
  c.grains->boundary_x = GrainBoundaryX::periodic;
  const auto run = [&](Real shift) {
    InitialGrains grains;
    const auto at = [&](Real x) { return std::fmod(x + shift + 0.01, 0.01); };
    add_turned(grains, kD, {at(5e-3), 5e-3, 0.2e-4}, rotation_about({0, 0, 1}, 0.3), {1, 0, 0});
    add_turned(grains, kD, {at(5e-3 + 1.6 * kD), 5.03e-3, 9.99e-3},
               rotation_about({0.6, 0, 0.8}, 1), {-1, 0, 0}, {0, 0, 500});
    ClumpBench bench(c, grains);
    const Real before = sums_of(bench.state).energy;
    bench.advance(600, 5e-7);
    EXPECT_LT(sums_of(bench.state).energy, 0.98 * before);
    EXPECT_GT(bench.solver.list().rebuilds(), 2);
    return bench.clumps();
  };
  const auto middle = run(0), seam = run(5e-3 - 0.8 * kD);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT(norm(seam[k].u - middle[k].u), 1e-9) << k;
    EXPECT_LT(norm(seam[k].j - middle[k].j) / norm(middle[k].j), 1e-7) << k;
  }
}

/// Cubes, dimers and spheres come to rest on a glued floor, between walls and on a body: together
/// they press on these with their weight.
TEST(Clumps, RestWithTheirWeightOnFloorWallsAndABody) {
  Config c = grain_config();
  c.size = {1.6e-3, 6e-3, 1.6e-3};
  c.grains->boundary_x = GrainBoundaryX::wall;
  c.grains->boundary_z = GrainBoundaryZ::wall;
  c.grains->floor = GrainFloor::glued;
  c.grains->floor_diameter = kD;
  c.grains->gravity = {0, -9.81, 0};
  c.grains->kinds.resize(3);
  c.grains->kinds[0].name = "cube", c.grains->kinds[1].name = "dimer";
  c.grains->kinds[2].name = "sphere";
  c.grains->kinds[0].shape = {.shape = GrainShape::clump, .clump = NamedClump::cube};
  c.grains->kinds[1].shape = {.shape = GrainShape::clump, .clump = NamedClump::dimer};
  c.bodies = {{.name = "post",
               .shape = BodyShape::of<shapes::Cylinder>(),
               .centre = {8e-4, 8e-4},
               .radius = 3e-4,
               .height = 3e-4}};
  c.time.grain_step = 1.25e-6;
  InitialGrains grains;
  for (int g = 0; g < 60; ++g) {
    add_grain(grains, kD,
              {3e-4 + 3.3e-4 * (g % 4), 8e-4 + 3.3e-4 * (g / 16), 3e-4 + 3.3e-4 * (g / 4 % 4)});
    grains.kind.push_back(static_cast<std::uint8_t>(g % 3));
  }
  SystemState state;
  state.grains = make_grain_state(as_spheres(grains, *c.grains, 3), densities_of(*c.grains));
  CoupledStep step(c, state);
  step.start(state);
  for (int n = 0; n < 600; ++n) step.advance(state);
  const GrainState whole = whole_grains(*state.grains);
  const auto kin = host_copy(whole.kin);
  const auto force = host_copy(whole.contact_force);
  ASSERT_EQ(whole.n, 60);
  Vec3 pressed;
  Real weight = 0, fastest = 0;
  for (int g = 0; g < whole.n; ++g) {
    pressed += force(g);
    weight += 9.81 * kin(g).m;
    fastest = std::max(fastest, norm(kin(g).u));
  }
  EXPECT_LT(fastest, 2e-3);  // they fell at 0.1 m/s
  EXPECT_NEAR(pressed.y / weight, 1, 0.01);
  EXPECT_LT(std::hypot(pressed.x, pressed.z), 0.01 * weight);
  const Vec3 on_post = step.grain_solver()->body_loads()[0].load.force;
  EXPECT_LT(on_post.y, -0.02 * weight);
}

/// Sand sinks as its shape lets it, in each of three orientations that it keeps; terminal velocity
/// by the law for a sphere of its volume times the factor of its shape. In still water, and in
/// water that flows around it, in cells so wide that it hardly stirs them.
TEST(Clumps, SinkAsTheirShapeLetsThem) {
  const ClumpShape shape = clump_shape(named_clump("sand"));
  const Real edge = 8 * 40 * kD;
  Config still = still_water({edge, edge, edge});
  Config flowing = water_box({8, 8, 8}, {edge, edge, edge});
  const Real h = std::sqrt(Real(0.5));
  const struct {
    Real shadow;  // downwards
    Quaternion q;
  } poses[] = {{shape.projected_areas.x, {h, 0, 0, h}},
               {shape.projected_areas.y, {1, 0, 0, 0}},
               {shape.projected_areas.z, {h, h, 0, 0}}};
  Real slowest = 1, fastest = 0;
  for (const auto& [shadow, q] : poses) {
    const Real expected = terminal_velocity(kD, {shape.sphericity(), kPi / 4 / shadow});
    for (Config* c : {&still, &flowing}) {
      c->grains->gravity = {0, -9.81, 0};
      c->grains->shape = {.shape = GrainShape::clump, .clump = NamedClump::sand};
      c->time.fluid_step = 1e-4, c->time.grain_step = 1e-5;
      InitialGrains grains;
      add_turned(grains, kD, {0.413 * edge, 0.937 * edge, 0.571 * edge}, q);
      ClumpRun run(*c, grains);
      run.advance(300);
      const GrainKinematics at = run.first();
      expect_relative(fmt::format("sand sinks, {}", c->fluid ? "coupled" : "still"), -at.u.y,
                      expected, c->fluid ? 0.006 : 0.001);
      EXPECT_LT(std::hypot(at.u.x, at.u.z), 1e-5);
      slowest = std::min(slowest, -at.u.y), fastest = std::max(fastest, -at.u.y);
    }
  }
  EXPECT_GT(fastest / slowest, 1.08);
}

/// Linear shear of 40 1/s along x.
void set_shear(CoupledRun& run) {
  set_field(run.state.fluid->u.x, run.state.fluid->grid,
            [&](int, int j, int) { return 40 * run.state.fluid->grid.y_centre(j); });
  run.fill_ghosts();
}

Config sheared_box(const Scheme& scheme) {
  Config c = water_box({8, 10, 8}, {4e-3, 5e-3, 4e-3});
  scheme.choose(c.coupling);
  c.coupling.forces.lift = c.coupling.forces.torque = true;
  return c;
}
/// A clump that is almost one sphere; its two parts are smaller than the sphere that they share.
const ShapeConfig kAlmostASphere{.shape = GrainShape::clump,
                                 .spheres = {{{}, 1}, {{0, 0, 1e-3}, 1}}};

TEST(Clumps, AlmostASphereMovesInAFlowAsASphere) {
  for (const Scheme& scheme : kSchemes) {
    SCOPED_TRACE(scheme.name);
    Config c = sheared_box(scheme);
    c.grains->gravity = {0, -9.81, 0};
    InitialGrains grains;
    add_grain(grains, kD, {2.13e-3, 2.52e-3, 1.77e-3});
    const auto move = [&](CoupledRun& run) {
      set_shear(run);
      run.advance(20);
      EXPECT_LT(run.step.ledger().entries().at("largest_exchange_mismatch"), 1e-9);
      return host_copy(whole_grains(*run.state.grains).kin)(0);
    };
    CoupledRun alone(c, grains);
    const GrainKinematics sphere = move(alone);
    c.grains->shape = kAlmostASphere;
    ClumpRun pair(c, grains);
    const GrainKinematics clump = move(pair);
    EXPECT_GT(sphere.u.x, 0.02);
    EXPECT_LT(sphere.u.y, -5e-3);
    EXPECT_LT(sphere.omega.z, -2);
    const std::string name = scheme.name;
    expect_below(name + ": almost a sphere, velocity", norm(clump.u - sphere.u) / norm(sphere.u),
                 0.01);
    expect_relative(name + ": almost a sphere, spin", clump.omega.z, sphere.omega.z, 0.01);
    expect_below(name + ": almost a sphere, place", norm(clump.x - sphere.x) / kD, 0.05);
  }
}

/// A rod that lies askew, almost half of it past an open end: what it gets, the water loses.
TEST(Clumps, RodPastAnOpenEndGetsWhatTheWaterLoses) {
  for (const Scheme& scheme : kSchemes) {
    Config c = water_box({16, 10, 16}, {4e-3, 5e-3, 4e-3});
    scheme.choose(c.coupling);
    c.grains->boundary_x = GrainBoundaryX::exit;
    c.grains->shape = {.shape = GrainShape::clump, .spheres = {}};
    for (int k = 0; k < 40; ++k) c.grains->shape.spheres.push_back({{2. * k, 0, 0}, 1});
    InitialGrains grains;
    add_turned(grains, kD, {3.9e-3, 2.52e-3, 1.77e-3}, rotation_about({0, 1, 0}, kPi / 4));
    ClumpRun rod(c, grains);
    set_shear(rod);
    rod.advance(2);
    expect_below(std::string(scheme.name) + ": rod past an open end, mismatch",
                 rod.step.ledger().entries().at("largest_exchange_mismatch"), 1e-9);
  }
}

/// Frozen on the floor, where the gap counts for drag and lift.
TEST(Clumps, AlmostASphereOnTheFloorFeelsWhatASphereFeels) {
  for (const Scheme& scheme : kSchemes) {
    Config c = sheared_box(scheme);
    c.coupling.forces.wall_drag = true;
    c.fluid->bottom = WallFlow::no_slip;
    c.grains->frozen = true;
    InitialGrains grains;
    add_grain(grains, kD, {2.13e-3, kD / 2, 1.77e-3});
    const auto sum_of = [&](CoupledRun& run, const std::string& name) {
      Vec3 sum;
      for (const NamedForce& force : run.forces()) {
        if (force.name != name) continue;
        const auto values = host_copy(force.values);
        for (int g = 0; g < run.state.grains->n; ++g) sum += values(g);
      }
      return sum;
    };
    const auto stand = [&](CoupledRun& run) {
      set_shear(run);
      run.advance(2);
    };
    CoupledRun alone(c, grains);
    c.grains->shape = kAlmostASphere;
    ClumpRun pair(c, grains);
    stand(alone), stand(pair);
    const std::string name = scheme.name;
    expect_relative(name + ": drag on the floor", sum_of(pair, "force_drag").x,
                    sum_of(alone, "force_drag").x, 0.02);
    expect_relative(name + ": lift on the floor", sum_of(pair, "force_lift").y,
                    sum_of(alone, "force_lift").y, 0.02);
  }
}

/// A rod of six spheres in a viscous shear, with a grain step that serves spheres: the moment about
/// its long axis is a third of that of the sphere of its volume.
TEST(Clumps, ARodTurnsWithAViscousShear) {
  Config c = water_box({8, 10, 8}, {4e-3, 5e-3, 4e-3});
  c.fluid->density = 1260;
  c.fluid->kinematic_viscosity = 1e-3;
  c.coupling.forces.torque = true;
  c.time.fluid_step = 2e-5, c.time.grain_step = 2e-6;
  c.grains->shape.shape = GrainShape::clump;
  for (int n = 0; n < 6; ++n) c.grains->shape.spheres.push_back({{2.0 * n, 0, 0}, 1});
  InitialGrains grains;
  add_turned(grains, 1e-4, {2.13e-3, 2.52e-3, 1.77e-3}, {0.8, 0, 0.6, 0}, {}, {900, 0, 900});
  ClumpRun run(c, grains);
  set_shear(run);
  run.advance(10);  // the shear has not decayed yet
  expect_relative("spin of a rod in a viscous shear", run.first().omega.z, -20, 0.05);
  EXPECT_LT(std::hypot(run.first().omega.x, run.first().omega.y), 0.5);
}

}  // namespace
}  // namespace barchan
