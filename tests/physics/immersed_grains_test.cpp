// Grains that move in a flow resolved around them: drag of arrays, torque, spin in shear, momentum.
#include <gtest/gtest.h>

#include <numbers>

#include "src/case/immersed_checks.hpp"
#include "tests/support/lattice.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kD = 1e-3;    // [m]
constexpr Real kNu = 1e-4;   // [m^2/s]: creeping flow
constexpr Real kRho = 1000;  // of the water [kg/m^3]
constexpr Real kHeld = 1e9;  // density of grains that no force moves [kg/m^3]
constexpr Real pi = std::numbers::pi_v<Real>;

/// Box without drive, with steps of a twentieth of the time of diffusion over a cell.
Config immersed_box(const std::array<int, 3>& cells, Real h, Real density) {
  Config c = water_box(cells, {cells[0] * h, cells[1] * h, cells[2] * h});
  c.coupling.scheme = CouplingScheme::resolved;
  c.fluid->kinematic_viscosity = kNu;
  c.fluid->pressure_gradient = 0;
  c.grains->density = density;
  c.grains->skin = 1e-4 * kD;
  c.time.fluid_step = c.time.grain_step = 0.05 * h * h / kNu;
  return c;
}

/// A simple cubic array, its drag over that of Stokes with the mean velocity of the whole array:
/// Zick & Homsy (1982), table 2.
struct Packing {
  Real fraction, drag;
  int repeats = 2;  // along x and z: a box has three diameters
  Real spacing() const { return cubic_spacing(fraction, kD); }
};
constexpr Packing kLoose{0.064, 2.810};

/// Grains of an array between planes of symmetry.
struct Array {
  Packing packing;
  Real spacing, h;
  Config config;
  Array(const Packing& of, int cells, Real density)
      : packing(of),
        spacing(of.spacing()),
        h(spacing / cells),
        config(immersed_box({of.repeats * cells, cells, of.repeats * cells}, h, density)) {}
  /// Centres off the cells by parts of a cell along x and z.
  CoupledRun run(Real off_x = 0.3, Real off_z = 0.2) const {
    return {config, cubic_lattice({packing.repeats, 1, packing.repeats}, spacing, kD,
                                  {off_x * h, 0, off_z * h})};
  }
  Real stokes(Real speed) const { return 3 * pi * kNu * kRho * kD * speed; }
};

/// Drag on held grains over that in the table.
Real drag_of_array(const Packing& packing, int cells) {
  Array array(packing, cells, kHeld);
  constexpr Real gradient = 10;  // [Pa/m]
  array.config.fluid->pressure_gradient = gradient;
  CoupledRun run = array.run();
  const Real force = gradient * std::pow(array.spacing, 3);
  // The force comes to that of the gradient as the flow becomes steady.
  Real on_grain = 0;
  for (int rounds = 0; rounds < 256 && on_grain < (1 - 5e-4) * force; ++rounds) {
    run.advance(cells * cells / 4);
    on_grain = force_on_first(run, "force_flow").x;
  }
  expect_relative("force on a grain of an array", on_grain, force, 1e-3);
  const Real speed = run.step.fluid_report().bulk_velocity.x;
  return force / array.stokes(speed) / packing.drag;
}

TEST(ImmersedGrains, ArrayHasItsDrag) {
  expect_relative("drag of a cubic array, 8 cells a diameter", drag_of_array(kLoose, 16), 1, 0.05);
}

TEST(ImmersedGrainsNightly, ArrayHasItsDragOnFinerCells) {
  expect_relative("drag of a cubic array, 12 cells a diameter", drag_of_array(kLoose, 24), 1, 0.04);
}

// Nearly alone, four diameters apart: series of Sangani & Acrivos, Int. J. Multiphase Flow 8, 343
// (1982), as of Hasimoto (1959), at the fraction c: 1/(1 - 1.7601 c^(1/3) + c - 1.5593 c^2 + ...).
TEST(ImmersedGrainsNightly, GrainsFarApartHaveTheirDrag) {
  expect_relative("drag of a cubic array, solid fraction 0.008, 8 cells a diameter",
                  drag_of_array({0.008, 1.5246, 2}, 32), 1, 0.04);
}

TEST(ImmersedGrainsNightly, DenseArraysHaveTheirDrag) {
  struct Case {
    Packing packing;
    int cells;  // of a spacing, about eight a diameter
    Real tolerance;
  };
  for (const auto& [packing, cells, tolerance] :
       {Case{{0.125, 4.292}, 13, 0.06}, Case{{0.216, 7.442, 3}, 11, 0.08},
        Case{{0.343, 15.4, 3}, 9, 0.13}, Case{{0.45, 28.1, 3}, 8, 0.17},
        Case{{0.523, 42.1, 3}, 8, 0.15}, Case{kLoose, 16, 0.05}}) {
    const std::string what = "drag of a cubic array, solid fraction " +
                             std::to_string(packing.fraction) + ", cells a diameter ";
    for (const int finer : {1, 2}) {
      const Real diameter = finer * cells * kD / packing.spacing();
      expect_relative(what + std::to_string(diameter), drag_of_array(packing, finer * cells), 1,
                      finer == 1 ? tolerance : 0.03);
    }
  }
}

/// Speed of an array that sinks along x through water that flows back, over that of the table.
Real sinking_speed(int cells, Real ratio) {
  Array array(kLoose, cells, ratio * kRho);
  Config& c = array.config;
  const Real pull = 1e-2;  // [m/s^2]
  const Real weight = (ratio - 1) * kRho * volume_of(kD) * pull;
  c.fluid->pressure_gradient = -weight / std::pow(array.spacing, 3);
  c.grains->gravity = {pull, 0, 0};
  CoupledRun run = array.run();
  run.advance(6 * cells * cells);
  const Real speed = run.velocity_of(1).x - run.step.fluid_report().bulk_velocity.x;
  return speed / (weight / (array.stokes(1) * kLoose.drag));
}

TEST(ImmersedGrains, ArraySinksAsFastAsItsDragAllows) {
  for (const Real ratio : {2.5, 1.05, 0.5})
    expect_relative("speed of a sinking array, density ratio " + std::to_string(ratio),
                    sinking_speed(16, ratio), 1, 0.05);
}

TEST(ImmersedGrains, SpinningGrainHasItsTorque) {
  constexpr int cells = 32, steps = 800;  // 4 diameters
  constexpr Real h = kD / 8, omega = 1;
  Config c = immersed_box({cells, cells, cells}, h, kHeld);
  c.fluid->bottom = c.fluid->top = WallFlow::no_slip;
  InitialGrains grains;
  const Real middle = 0.5 * cells * h;
  add_grain(grains, kD, {middle + 0.3 * h, middle + 0.1 * h, middle - 0.2 * h}, {}, {0, 0, omega});
  CoupledRun run(c, grains);
  run.advance(steps);
  const Vec3 torque = force_on_first(run, "torque_flow");
  expect_relative("torque on a spinning grain", -torque.z, pi * kNu * kRho * kD * kD * kD * omega,
                  0.04);
  EXPECT_LT(std::abs(torque.x) + std::abs(torque.y), 2e-3 * norm(torque));
}

TEST(ImmersedGrains, FreeGrainInShearSpinsWithHalfTheRate) {
  constexpr int cells = 32, steps = 1200;  // 4 diameters
  constexpr Real h = kD / 8, speed = 1e-3;
  Config c = immersed_box({cells, cells, cells}, h, 2500);
  c.fluid->bottom = c.fluid->top = WallFlow::no_slip;
  c.fluid->top_velocity = speed;
  InitialGrains grains;
  const Real middle = 0.5 * cells * h;
  add_grain(grains, kD, {middle + 0.3 * h, middle, middle}, {speed / 2, 0, 0});
  CoupledRun run(c, grains);
  set_faces(run.state.fluid->u, run.state.fluid->grid, [&](std::size_t axis, Real, Real y, Real) {
    return axis == 0 ? speed * y / (cells * h) : 0;
  });
  run.fill_ghosts();
  run.advance(steps);
  const Real rate = speed / (cells * h);
  expect_relative("spin of a free grain over half the shear rate", run.rows()[1].omega.z, -rate / 2,
                  0.03);
}

// O'Neill, Chem. Eng. Sci. 23, 1293 (1968): a sphere that touches a wall in slow shear. The lid is
// two diameters up; the next spheres are four diameters away, which adds some 3 %.
TEST(ImmersedGrains, GrainOnTheFloorHasONeillsDragAndTorque) {
  constexpr int cells = 16;
  constexpr Real h = kD / 8, r = kD / 2, speed = 1e-3, rate = speed / (cells * h);
  Config c = immersed_box({2 * cells, cells, 2 * cells}, h, kHeld);
  c.fluid->bottom = c.fluid->top = WallFlow::no_slip;
  c.fluid->top_velocity = speed;
  InitialGrains grains;
  add_grain(grains, kD, {cells * h + 0.3 * h, r, cells * h - 0.2 * h});
  CoupledRun run(c, grains);
  set_faces(run.state.fluid->u, run.state.fluid->grid,
            [&](std::size_t axis, Real, Real y, Real) { return axis == 0 ? rate * y : 0; });
  run.fill_ghosts();
  run.advance(static_cast<int>(6 * r * r / (kNu * run.step.dt())));
  const Real mu = kNu * kRho;
  expect_relative("drag of a grain on the floor", force_on_first(run, "force_flow").x,
                  1.7009 * 6 * pi * mu * r * r * rate, 0.08);
  expect_relative("torque of a grain on the floor", -force_on_first(run, "torque_flow").z,
                  0.944 * 4 * pi * mu * r * r * r * rate, 0.08);
}

/// Speed of a grain that leaves the floor at a gap, over that at which it came; water almost
/// without friction.
Real kept_speed(Real density) {
  constexpr int cells = 12;  // a diameter
  const Real h = kD / cells, speed = 0.1, gap = 0.1 * kD;
  Config c = immersed_box({4 * cells, 3 * cells, 4 * cells}, h, density);
  c.fluid->kinematic_viscosity = 1e-7;
  c.grains->material.youngs_modulus = c.grains->wall.youngs_modulus = 1e9;
  c.grains->material.restitution = c.grains->wall.restitution = 1;
  c.time = {.fluid_step = 0.2 * h / speed, .grain_step = 0.002 * h / speed};
  InitialGrains grains;
  add_grain(grains, kD, {2.03 * kD, kD, 1.98 * kD}, {0, -speed, 0});
  CoupledRun run(c, grains);
  Real in = 0, out = 0;
  for (int s = 0; s < 20 * cells && out == 0; ++s) {
    const GrainRow before = run.rows()[1];
    run.advance();
    const GrainRow now = run.rows()[1];
    const Real at = 0.5 * kD + gap;
    if (before.x.y > at && now.x.y <= at) in = -now.u.y;
    if (before.x.y < at && now.x.y >= at) out = now.u.y;
  }
  return out / in;
}

TEST(ImmersedGrains, GrainLeavesTheFloorWithTheWaterThatItTurnsRound) {
  for (const auto& [ratio, tolerance] : {std::pair{2.5, 0.3}, std::pair{8.0, 0.15}})
    expect_relative("speed after a contact, density ratio " + std::to_string(ratio),
                    kept_speed(ratio * kRho), 1, tolerance);
}

/// Momentum of water and grains, and what grains will get of it in the next step [N s].
Vec3 momentum(CoupledRun& run) {
  const GrainState& grains = *run.state.grains;
  const auto kin = host_copy(grains.kin);
  const auto inside = host_copy(grains.exchange.inner_momentum);
  const auto force = host_copy(grains.exchange.resolved_force);
  const auto added = host_copy(grains.fluid.added_mass);
  const auto acceleration = host_copy(grains.fluid.acceleration);
  const FaceVector& u = run.state.fluid->u;
  const test::HostGrid h(run.state.fluid->grid);
  const HostField x = to_host(u.x), y = to_host(u.y), z = to_host(u.z);
  Vec3 sum;
  for_owned_cells(run.state.fluid->grid, [&](int i, int j, int k) {
    sum += (kRho * h.volume(j)) * Vec3{x(i, j, k), y(i, j, k), z(i, j, k)};
  });
  for (int g = 0; g < grains.n; ++g)
    sum +=
        kin(g).m * kin(g).u - inside(g) + run.step.dt() * (force(g) + added(g) * acceleration(g));
  return sum;
}

TEST(ImmersedGrains, MomentumAlongTheFloorIsKept) {
  constexpr int cells = 32;
  const Real h = kD / 8;
  Config c = immersed_box({cells, cells, cells}, h, 2500);
  InitialGrains grains;
  add_grain(grains, kD, {1.0e-3, 0.7e-3, 1.0e-3}, {2e-2, 1e-2, 0}, {3, 2, 1});
  add_grain(grains, 0.9 * kD, {2.1e-3, 0.9e-3, 1.2e-3}, {-2e-2, 0, 5e-3});
  add_grain(grains, kD, {3.0e-3, 3.1e-3, 3.6e-3}, {0, -1e-2, 5e-3}, {0, 5, 0});
  CoupledRun run(c, grains);
  const Vec3 before = momentum(run);
  const Real scale = 2500 * volume_of(kD) * 2e-2;
  Real worst = 0;
  for (int s = 0; s < 100; ++s) {
    run.advance();
    const Vec3 off = momentum(run) - before;
    worst = std::max({worst, std::abs(off.x), std::abs(off.z)});
  }
  expect_below("momentum of water and grains that changed, of that of a grain", worst / scale,
               1e-13);
}

/// Closed form of the approach of two surfaces with the film between them alone: the speed falls
/// with the logarithm of the gap. m_eff dv/dt = -(c/gap - c/reach) v, dgap/dt = -v:
///   v(gap) = v_0 - (c ln(gap_0/gap) - c (gap_0 - gap)/reach) / m_eff.
TEST(Lubrication, FilmSlowsAnApproachAsItsIntegral) {
  Config c = grain_config();
  c.grains->contact_model = ContactModel::of<HertzLubricated>();
  GrainsCase grains_case = c;
  const Real d = 1e-3, reach = 2e-4, gap_0 = 1.5e-4, v_0 = 0.05, mu = 1e-3;
  grains_case.film = {.viscosity = mu, .reach = reach};
  InitialGrains grains;
  add_grain(grains, d, {4e-3, 5e-3, 5e-3}, {v_0 / 2, 0, 0});
  add_grain(grains, d, {4e-3 + d + gap_0, 5e-3, 5e-3}, {-v_0 / 2, 0, 0});
  GrainState state = make_grain_state(grains, c.grains->density);
  GrainSolver solver(grains_case, state);
  solver.start(state);
  solver.advance(state, 1000, 2e-6);
  const auto rows = rows_by_id(state);
  const Real gap = rows[2].x.x - rows[1].x.x - d, v = rows[1].u.x - rows[2].u.x;
  const Real r_eff = d / 4, m_eff = c.grains->density * volume_of(d) / 2;
  const Real damping = film_damping(mu, r_eff, 1);
  const Real slower = damping * (std::log(gap_0 / gap) - (gap_0 - gap) / reach) / m_eff;
  EXPECT_LT(gap, 0.6 * gap_0);
  EXPECT_GT(gap, 0);
  expect_relative("speed that the film takes", v_0 - v, slower, 1e-3);
  EXPECT_EQ(rows[1].omega.z, 0);
}

/// The film of two equal grains that nearly touch, 6 pi mu R_eff^2 (1/gap - 1/reach), as the
/// longest grain step has it: half of m_eff over it.
TEST(Lubrication, ThinnestFilmIsThatOfTheCase) {
  Config c = immersed_box({32, 32, 32}, kD / 8, 2500);
  c.grains->contact_model = ContactModel::of<HertzLubricated>();
  const Real r_eff = kD / 4, m_eff = 2500 * volume_of(kD) / 2, reach = 2 * kD / 8;
  for (const Real thinnest : {3e-3, 3e-4}) {
    c.grains->thinnest_film = thinnest;
    const Real gap = thinnest * kD / 2;
    const Real film = film_damping(kRho * kNu, r_eff, gap) - film_damping(kRho * kNu, r_eff, reach);
    expect_relative("longest step with a film", film_step_limit(c, {{.diameter = kD}}),
                    0.5 * m_eff / film, 1e-6);
  }
}

TEST(Lubrication, LawIsThatOfTheFilmThenOfTheContact) {
  const ContactMaterial material{.a = {.youngs_modulus = 5e6, .poisson_ratio = 0.3},
                                 .b = {.youngs_modulus = 5e6, .poisson_ratio = 0.3},
                                 .restitution = 0.5,
                                 .film_viscosity = 1e-3,
                                 .film_reach = 1e-4,
                                 .thinnest_film = 6e-3};
  const auto law = HertzLubricated::from(material);
  const auto hertz = HertzMindlin::from(material);
  const Real r = 1e-4, m = 1e-8;
  const ContactStiffness apart = law(r, m, -1e-5), at_reach = law(r, m, -1e-4),
                         thin = law(r, m, -1e-9), touching = law(r, m, 1e-6);
  EXPECT_EQ(apart.elastic, 0);
  EXPECT_EQ(apart.k_t, 0);
  EXPECT_NEAR(apart.gamma_n, film_damping(1e-3, r, 1e-5) - film_damping(1e-3, r, 1e-4), 1e-18);
  EXPECT_EQ(at_reach.gamma_n, 0);
  EXPECT_NEAR(thin.gamma_n, film_damping(1e-3, r, 6e-7) - film_damping(1e-3, r, 1e-4), 1e-16);
  EXPECT_EQ(touching.gamma_n, hertz(r, m, 1e-6).gamma_n);
  EXPECT_EQ(touching.elastic, hertz(r, m, 1e-6).elastic);
}

}  // namespace
}  // namespace barchan
