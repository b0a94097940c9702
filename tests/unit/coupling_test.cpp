// Exchange between fluid and grains: nothing is lost on the way, in either direction.
#include <gtest/gtest.h>

#include "kernels/coupling/deposit.hpp"
#include "kernels/coupling/gather.hpp"
#include "kernels/grains/sphere.hpp"
#include "src/initial/initial_flow.hpp"
#include "src/initial/initial_state.hpp"
#include "src/parallel/poison.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/coupling_schemes.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using test::coupled_config;

struct Coupled : test::CoupledRun {
  explicit Coupled(const Config& c) : CoupledRun(c, make_initial_state(c, {})) {}
};

GrainExchange exchange_of_first(const ExchangeOfGrain& of) {
  const Kokkos::View<GrainExchange*> result("test: exchange", 1);
  Kokkos::parallel_for(
      "test: exchange", 1, KOKKOS_LAMBDA(int g) { result(g) = of(g); });
  return host_copy(result)(0);
}

// A grain gives the fluid the impulse that it got in the grain steps, and that of the steady
// forces.
TEST(Coupling, ExchangeOfAGrainIsItsImpulseAndTheSteadyPart) {
  const Real dt = 2.5e-4, beta = 3e-6;
  const Kokkos::View<GrainKinematics*> grains("test: grain", 1);
  Kokkos::deep_copy(grains, {.x = {}, .r = 1e-4, .u = {0.3, 0.1, 0}, .m = 1e-8, .omega = {}});
  FluidOnGrains on;
  on.beta = Kokkos::View<Real*>("test: beta", 1);
  on.impulse = Kokkos::View<Vec3*>("test: impulse", 1);
  ExchangeOnGrains exchange;
  exchange.added_mass_force = Kokkos::View<Vec3*>("test: convective", 1);
  exchange.lift = Kokkos::View<Vec3*>("test: lift", 1);
  Kokkos::deep_copy(on.beta, beta);
  Kokkos::deep_copy(on.impulse, Vec3{1e-10, 2e-10, 3e-10});
  Kokkos::deep_copy(exchange.added_mass_force, Vec3{4e-7, 0, 0});
  Kokkos::deep_copy(exchange.lift, Vec3{0, 5e-7, 0});
  const ExchangeOfGrain of{.dt = dt, .grains = grains, .on_grains = on, .exchange = exchange};
  const GrainExchange given = exchange_of_first(of);
  EXPECT_NEAR(given.volume, sphere_volume(1e-4), 1e-15 * given.volume);
  const Vec3 impulse{1e-10 + dt * 4e-7, 2e-10 + dt * 5e-7, 3e-10};
  EXPECT_NEAR(norm(given.impulse - impulse), 0, 1e-14 * norm(impulse));
}

TEST(Coupling, LedgerClosesToRoundOff) {
  Coupled c(coupled_config());
  c.advance(30);
  const auto& entries = c.step.ledger().entries();
  test::expect_below("ledger, volume", entries.at("largest_volume_mismatch"), 1e-12);
  test::expect_below("ledger, momentum", entries.at("largest_exchange_mismatch"), 1e-10);
  EXPECT_GT(entries.at("impulse_given_to_grains_x"), 0) << "the flow pushes the grains along";
}

TEST(Coupling, LedgerClosesWithEveryVoidFractionAndDragLaw) {
  for (const test::Scheme& scheme : {test::kSchemes[0], test::kSchemes[2]}) {
    for (const DragLaw law : DragLaw::all()) {
      Config config = coupled_config();
      scheme.choose(config.coupling);
      config.coupling.drag = law;
      Coupled c(config);
      c.advance(3);
      EXPECT_LT(c.step.ledger().entries().at("largest_exchange_mismatch"), 1e-10);
      EXPECT_LT(c.step.ledger().entries().at("largest_volume_mismatch"), 1e-12);
    }
  }
}

TEST(Coupling, LedgerClosesWithAllForces) {
  Config config = coupled_config();
  ForceSwitches& forces = config.coupling.forces;
  forces.lift = forces.torque = forces.wall_drag = forces.mixture_viscosity = true;
  config.coupling.drag = DragLaw::of<GidaspowBlended>();
  Coupled c(config);
  c.advance(30);
  const auto& entries = c.step.ledger().entries();
  EXPECT_LT(entries.at("largest_exchange_mismatch"), 1e-10);
}

struct SolidFraction {
  GridRef grid;
  ConstFieldRef alpha;
  bool times_volume;
  KOKKOS_FUNCTION Real operator()(int i, int j, int k) const {
    return (1 - alpha(i, j, k)) * (times_volume ? grid.cell_volume(j) : Real(1));
  }
};

TEST(Coupling, FluidFractionIsThatOfTheGrainsAndBounded) {
  Coupled c(coupled_config());
  const Grid grid = c.state.fluid->grid;
  const Field alpha = c.state.fluid->alpha_f;
  const Real solid = sum_each_cell("test: solid", grid, SolidFraction{grid, alpha, true});
  const Real expected =
      20 * sphere_volume(7.5e-5) + 160 * sphere_volume(1e-4) + 20 * sphere_volume(1.25e-4);
  EXPECT_NEAR(solid / expected, 1, 1e-12);
  const Real densest = max_each_cell("test: densest", grid, SolidFraction{grid, alpha, false});
  EXPECT_GT(densest, 0.05);
  EXPECT_LT(densest, 0.75);
}

/// One grain in a corner of 40 x 4 x 30 cells of 0.3 mm, smoothed over 0.3 mm; with `images` those
/// of the grain in walls at x = 0 and z = 0, in a periodic box of twice the size.
test::CoupledRun grain_in_a_corner(bool images, CouplingScheme scheme = CouplingScheme::layered) {
  constexpr double h = 3e-4;
  const int n = images ? 2 : 1;
  Config c = test::water_box({40 * n, 4, 30 * n}, {40 * n * h, 4 * h, 30 * n * h});
  c.coupling.smoothing_length = h;
  c.coupling.scheme = scheme;
  c.grains->boundary_x = images ? GrainBoundaryX::periodic : GrainBoundaryX::wall;
  c.grains->boundary_z = images ? GrainBoundaryZ::periodic : GrainBoundaryZ::wall;
  InitialGrains grains;
  const Vec3 x{1.2e-4, 5e-4, 1.3e-4};
  test::add_grain(grains, 2e-4, x);
  if (images) {
    const double lx = c.size[0], lz = c.size[2];
    test::add_grain(grains, 2e-4, {lx - x.x, x.y, x.z});
    test::add_grain(grains, 2e-4, {x.x, x.y, lz - x.z});
    test::add_grain(grains, 2e-4, {lx - x.x, x.y, lz - x.z});
  }
  return {c, grains};
}

TEST(Coupling, WallsOfTheGrainsMirrorTheSolidFraction) {
  const test::CoupledRun walls = grain_in_a_corner(false), images = grain_in_a_corner(true);
  const Grid& grid = walls.state.fluid->grid;
  const auto alpha = test::to_host(walls.state.fluid->alpha_f);
  const auto mirrored = test::to_host(images.state.fluid->alpha_f);
  double solid = 0, densest = 0, beyond = 0;
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    ASSERT_NEAR(alpha(i, j, k), mirrored(i, j, k), 1e-15);
    const double fraction = 1 - alpha(i, j, k);
    solid += fraction * std::pow(3e-4, 3);
    densest = std::max(densest, fraction);
    if (i >= 35 || k >= 25) beyond = std::max(beyond, std::abs(fraction));
  });
  EXPECT_NEAR(solid / sphere_volume(1e-4), 1, 1e-13);
  EXPECT_GT(densest, 0.02);
  EXPECT_LT(beyond, 1e-11) << "through the seam of the flow";
}

/// Exchange with one grain and its images, each lifted by the flow.
ExchangeOnFaces exchange_of(test::CoupledRun& run) {
  FluidSolver solver(run.config, run.state.fluid->grid);
  const auto scheme =
      make_exchange_scheme(run.config, solver, *run.state.grains, run.state.fluid->grid);
  scheme->gather(*run.state.fluid, *run.state.grains, 1e-4);
  Kokkos::deep_copy(run.state.grains->fluid.impulse, Vec3{0, 1e-9, 0});
  scheme->deposit(*run.state.grains, *run.state.fluid, 1e-4);
  return *scheme->on_faces();
}

/// The impulse on faces across y, over its sum: the flow passes the walls of the grains, so the
/// faces there are shared.
TEST(Coupling, WallsOfTheGrainsMirrorTheExchange) {
  const auto faces_of = [](bool images) {
    test::CoupledRun run = grain_in_a_corner(images, CouplingScheme::smoothed);
    return test::to_host(exchange_of(run).impulse.y);
  };
  const auto walls = faces_of(false), images = faces_of(true);
  const auto each = [](auto action) {
    for (int k = 0; k < 30; ++k)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 40; ++i) action(i, j, k);
  };
  double sum = 0, image_sum = 0, most = 0;
  each([&](int i, int j, int k) { sum += walls(i, j, k), image_sum += images(i, j, k); });
  each([&](int i, int j, int k) {
    ASSERT_NEAR(walls(i, j, k) / sum, images(i, j, k) / image_sum, 1e-13);
    most = std::max(most, walls(i, j, k) / sum);
  });
  EXPECT_GT(most, 0.05);
}

/// A grain across the face between rows 1 and 2, half of it above, just before an x-face and
/// behind a z-face.
TEST(Coupling, RowsThatShareAGrainAreCoupledInItsMomentumCells) {
  constexpr double h = 3e-4;
  const Config c = test::water_box({6, 4, 6}, {6 * h, 4 * h, 6 * h});
  InitialGrains grains;
  test::add_grain(grains, 2e-4, {3.9 * h, 2 * h, 2.1 * h});
  test::CoupledRun run(c, grains);
  const ExchangeOnFaces exchange = exchange_of(run);
  const auto x = test::to_host(exchange.interlayer_drag_x),
             z = test::to_host(exchange.interlayer_drag_z);
  const double beta = host_copy(run.state.grains->fluid.beta)(0);
  const double expected = 1e-4 * beta * 0.25 / (h * h * h);
  test::for_owned_cells(run.state.fluid->grid, [&](int i, int j, int k) {
    EXPECT_NEAR(x(i, j, k), i == 4 && j == 2 && k == 2 ? expected : 0, 1e-12 * expected);
    EXPECT_NEAR(z(i, j, k), i == 3 && j == 2 && k == 2 ? expected : 0, 1e-12 * expected);
  });
}

/// Drag law and stress read the deposited fraction in layers, at the walls, too.
TEST(Coupling, TheSmoothingIsUndoneAtWallsOfTheGrains) {
  const auto fraction = [](double smoothing) {
    test::CoupledRun run = grain_in_a_corner(false, CouplingScheme::layered);
    run.config.coupling.smoothing_length = smoothing;
    test::CoupledRun again(run.config, std::move(run.state));
    if (smoothing == 0) return test::to_host(again.state.fluid->alpha_f);
    return test::to_host(exchange_of(again).alpha_raw);
  };
  const auto alpha_raw = fraction(3e-4), deposited = fraction(0);
  double least = 1;
  for (int k = 0; k < 30; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 40; ++i) {
        ASSERT_NEAR(alpha_raw(i, j, k), deposited(i, j, k), 1e-13);
        least = std::min(least, deposited(i, j, k));
      }
  EXPECT_LT(least, 0.95);
}

TEST(Coupling, PressureConvergesAndContinuityHolds) {
  Config config = coupled_config();
  config.solver.pressure_tolerance = 1e-6;
  Coupled c(config);
  for (int s = 0; s < 20; ++s) {
    c.advance(1);
    EXPECT_LE(c.step.fluid_report().pressure_iterations, 20);
    EXPECT_LE(c.step.fluid_report().pressure_residual, 1e-6);
    EXPECT_LT(c.step.fluid_report().continuity_residual, 1e-4);
  }
}

/// Values of all fields of a flow, ghosts that are not kept left out.
std::vector<Real> owned_values(const FluidState& fluid) {
  std::vector<Real> values;
  for_each_fluid_field(fluid, [&](const auto& member, const FluidField&) {
    for_each_component(member, [&](const Field& f, const char*) {
      const auto host = test::to_host(f);
      test::for_owned_cells(fluid.grid,
                            [&](int i, int j, int k) { values.push_back(host(i, j, k)); });
    });
  });
  return values;
}

TEST(Coupling, TheFlowDoesNotReadWhatOthersLeftInIdleFields) {
  Coupled a(coupled_config()), b(coupled_config());
  a.advance(3), b.advance(3);
  for (const Field& field : b.step.fluid_solver()->workspace().of_any_bits()) {
    Kokkos::deep_copy(field.storage, Kokkos::Experimental::quiet_NaN_v<Real>);
  }
  for (Coupled* c : {&a, &b}) c->step.advance_fluid(c->state);
  EXPECT_EQ(owned_values(*a.state.fluid), owned_values(*b.state.fluid));
}

/// A heap of 200 grains in a channel of five times its width.
Config wide_config() {
  Config config = coupled_config();
  config.size[0] = 0.036, config.size[2] = 0.03;
  config.fluid->cells[0] = 30, config.fluid->cells[2] = 30;
  return config;
}

/// Memory that is shared is no number before it is written, and no number beyond the cells in which
/// it is written: neither is read.
TEST(Coupling, NothingIsReadThatOthersLeft) {
  for (const test::Scheme& scheme : test::kSchemes) {
    for (const Real length : {0.0, 6e-4}) {
      SCOPED_TRACE(scheme.name);
      Config config = wide_config();
      scheme.choose(config.coupling);
      config.coupling.smoothing_length = length;
      Coupled a(config), b(config);
      a.advance(3);
      poisons_lent_memory = true;
      b.advance(3);
      poisons_lent_memory = false;
      EXPECT_EQ(owned_values(*a.state.fluid), owned_values(*b.state.fluid));
      const auto of_a = a.rows(), of_b = b.rows();
      for (std::size_t g = 0; g < of_a.size(); ++g) EXPECT_EQ(norm(of_a[g].u - of_b[g].u), 0);
      const auto& ledger = b.step.ledger().entries();
      EXPECT_LT(ledger.at("largest_exchange_mismatch"), 1e-10);
      if (scheme.keeps_volume()) {
        EXPECT_LT(ledger.at("largest_volume_mismatch"), 1e-12);
      }
    }
  }
}

/// Values of the flow after two steps of a scheme.
std::vector<Real> after_two_steps(const test::Scheme& scheme) {
  Config config = coupled_config();
  scheme.choose(config.coupling);
  Coupled c(config);
  c.advance(2);
  return owned_values(*c.state.fluid);
}

TEST(Coupling, NoTwoSchemesAreTheSame) {
  std::vector<std::vector<Real>> seen;
  for (const test::Scheme& scheme : test::kSchemes) {
    const auto values = after_two_steps(scheme);
    EXPECT_EQ(std::ranges::count(seen, values), 0) << scheme.name;
    seen.push_back(values);
  }
}

TEST(Coupling, BulkVelocityIsHeld) {
  Coupled c(coupled_config());
  c.advance(40);
  EXPECT_NEAR(bulk_velocity(*c.state.fluid), 0.2, 2e-4);
}

/// Velocity along x of a lone grain without drag after two steps in a flow of a bulk velocity of
/// 0.2 m/s, over that.
double thrown(bool uniform_start) {
  Config c = test::water_box({8, 8, 8}, {4e-3, 4e-3, 4e-3});
  c.fluid->mean_velocity = 0.2;
  c.coupling.drag = DragLaw::of<NoDrag>();
  InitialGrains grain;
  test::add_grain(grain, 2e-4, {2e-3, 2e-3, 2e-3});
  test::CoupledRun run(c, grain);
  if (uniform_start) set_flow(UniformFlow{}, c, *run.state.fluid);
  run.fill_ghosts();
  run.advance(2);
  return run.velocity_of(1).x / 0.2;
}

/// Water that is brought up from rest at once takes a free sphere along, to
/// (1 + C_m)/(rho_p/rho_f + C_m) of its velocity.
TEST(Coupling, AUniformStartDoesNotThrowTheGrains) {
  EXPECT_NEAR(thrown(false), 1.5 / 3.0, 0.01);
  EXPECT_NEAR(thrown(true), 0, 2e-3);  // the fluid still makes way for it
  Config c = coupled_config();
  c.initial.fluid = "uniform";
  const Coupled dune(c);
  EXPECT_NEAR(bulk_velocity(*dune.state.fluid), 0.2, 1e-13);
}

TEST(Coupling, FrozenGrainsStayAndDragTheFlow) {
  Config config = coupled_config();
  config.grains->frozen = true;
  Coupled c(config);
  const auto before = c.rows();
  c.advance(10);
  const auto after = c.rows();
  for (std::size_t id = 1; id < after.size(); ++id) {
    EXPECT_EQ(norm(after[id].x - before[id].x), 0);
  }
  EXPECT_GT(c.step.ledger().entries().at("impulse_taken_from_fluid_x"), 0);
  EXPECT_LT(c.step.ledger().entries().at("largest_exchange_mismatch"), 1e-10);
}

/// Parts of the force on each grain: contact forces add up to what the contacts gave, all parts and
/// the weight to the total.
TEST(Coupling, PartsOfTheForceAddUp) {
  for (const CouplingScheme scheme : {CouplingScheme::smoothed, CouplingScheme::layered}) {
    Config config = coupled_config();
    config.output.grain_forces = true;
    config.coupling.scheme = scheme;
    config.coupling.forces.lift = true;
    Coupled c(config);
    c.advance(5);
    const auto forces = c.forces();
    ASSERT_EQ(forces.size(), 8u);
    const auto kin = host_copy(c.state.grains->kin);
    const auto contact = host_copy(c.state.grains->contact_force);
    const auto n = static_cast<std::size_t>(c.state.grains->n);
    std::vector<Vec3> of_contacts(n), of_all(n), total(n);
    for (const test::NamedForce& f : forces) {
      const auto values = host_copy(f.values);
      for (std::size_t g = 0; g < n; ++g) {
        if (f.name.starts_with("force_contact")) of_contacts[g] += values(g);
        (f.name == "force_total" ? total : of_all)[g] += values(g);
        if (f.name == "force_pressure_gradient" || f.name == "force_stress" ||
            f.name == "force_lift") {
          EXPECT_GT(norm(values(g)), 0) << f.name;
        }
      }
    }
    for (std::size_t g = 0; g < n; ++g) {
      const double size = norm(contact(g)) + norm(total[g]) + kin(g).m * 9.81;
      const Vec3 weight{0, -9.81 * (kin(g).m - 1000 * sphere_volume(kin(g).r)), 0};
      EXPECT_NEAR(norm(of_contacts[g] - contact(g)), 0, 1e-12 * size);
      EXPECT_NEAR(norm(of_all[g] + weight - total[g]), 0, 1e-12 * size);
    }
  }
}

}  // namespace
}  // namespace barchan
