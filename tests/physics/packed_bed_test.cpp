// Flow through a bed of grains: pressure drop, and when it carries the bed.
#include <fmt/format.h>

#include "tests/support/lattice.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using test::CoupledRun;

constexpr double kDiameter = 2e-4;

struct Bed {
  double alpha, superficial;  // [-], [m/s]
  double smoothing = 0;       // [m]
  int last = 22;              // of the cells that the grains lie in; the first is 6
  CouplingScheme scheme = CouplingScheme::layered;
};

/// Frozen grains over x-cells 6 to 22 of 28, two lattice spacings per cell, the flow along x.
struct FrozenBed {
  static constexpr int kCells = 28, kFirst = 6;
  double spacing;
  CoupledRun run;

  explicit FrozenBed(const Bed& bed)
      : spacing(test::cubic_spacing(1 - bed.alpha, kDiameter)), run(config(bed), grains(bed)) {}

  Config config(const Bed& bed) const {
    const double a = spacing, share = double(bed.last - kFirst) / kCells;
    Config c = test::water_box({kCells, 2, 2}, {2 * kCells * a, 4 * a, 4 * a});
    c.grains->frozen = true;
    c.grains->skin = 1e-6;
    c.coupling.smoothing_length = bed.smoothing;
    c.coupling.scheme = bed.scheme;
    c.fluid->mean_velocity = bed.superficial / (1 - (1 - bed.alpha) * share);
    return c;
  }
  InitialGrains grains(const Bed& bed) const {
    return test::cubic_lattice({2 * (bed.last - kFirst), 4, 4}, spacing, kDiameter,
                               {2 * kFirst * spacing, 0, 0});
  }
  /// Slope of the whole pressure between the centres of two columns of cells [Pa/m].
  double gradient(int i0, int i1) const {
    const FluidState& f = *run.state.fluid;
    const auto p = [&](int i) { return test::mean_of_columns(f.p, f.grid, i, i + 1); };
    return 1000 * f.drive.x - (p(i1) - p(i0)) / ((i1 - i0) * f.grid.dx);
  }
};

/// Compared at the flux that has come about: the drive holds the bulk velocity only before the
/// pressure correction, which in a bed that blocks the whole channel takes a part of it away again.
void check_ergun(const Bed& bed) {
  FrozenBed frozen(bed);
  frozen.run.advance(60);
  const FluidState& f = *frozen.run.state.fluid;
  const auto flux = [&](int i) {  // alpha u on the x-face between two cells
    return test::mean_of_columns(f.u.x, f.grid, i, i + 1) *
           test::mean_of_columns(f.alpha_f, f.grid, i - 1, i + 1);
  };
  const double alpha = test::mean_of_columns(f.alpha_f, f.grid, 13, 15), superficial = flux(14);
  EXPECT_NEAR(flux(1) / superficial, 1, 1e-5) << "continuity";
  EXPECT_NEAR(alpha, bed.alpha, 1e-3);
  const double measured = frozen.gradient(12, 15);
  const double ergun = test::ergun_gradient(bed.alpha, superficial, kDiameter);
  test::save_result("packed_bed", {{"alpha", bed.alpha},
                                   {"superficial", superficial},
                                   {"smoothing", bed.smoothing},
                                   {"gradient", measured},
                                   {"ergun", ergun}});
  test::expect_relative("Ergun, alpha " + std::to_string(bed.alpha) + " [Pa/m]", measured, ergun,
                        0.03);
  test::print_measured("superficial velocity over its target", superficial / bed.superficial, 1, 1);
}

/// Grains placed in a steady flow through themselves, as after a run that held them, feel from the
/// first step on what they felt there.
TEST(PackedBed, ANewRunGoesOnInASteadyFlow) {
  const Bed bed{.alpha = 0.4, .superficial = 1e-3};
  FrozenBed steady(bed), again(bed);
  steady.run.advance(60);
  again.run.state.fluid = steady.run.state.fluid;
  again.run.fill_ghosts();
  again.run.advance(1);
  test::expect_relative("impulse on the bed in the first step of a new run [N s]",
                        again.run.step.exchange().given_to_grains.x,
                        steady.run.step.exchange().given_to_grains.x, 0.05);
}

TEST(PackedBed, PressureDropIsErguns) {
  for (const double alpha : {0.4, 0.5, 0.7}) {
    for (const double superficial : {2e-4, 0.02, 0.1}) check_ergun({alpha, superficial});
  }
}

TEST(PackedBed, PressureDropIsErgunsWithSmoothing) { check_ergun({0.4, 0.01, 4e-4}); }

/// Drop of the pressure over a whole bed 15 d high, ends included, over Ergun's.
double drop_over_ergun(const Bed& bed) {
  FrozenBed frozen(bed);
  frozen.run.advance(400);
  const FluidState& f = *frozen.run.state.fluid;
  const double superficial =
      test::mean_of_columns(f.u.x, f.grid, 0, 1) * test::mean_of_columns(f.alpha_f, f.grid, 0, 1);
  const double height = 2 * (bed.last - FrozenBed::kFirst) * frozen.spacing;
  return 1000 * f.drive.x * f.grid.lx /
         (height * test::ergun_gradient(bed.alpha, superficial, kDiameter));
}

/// The smoothing spreads the solid fraction beyond the ends of a bed. Where the drag law reads the
/// smoothed one, the bed resists too little.
TEST(PackedBed, ShallowBedResistsAsErgunWhateverTheFractionIsSmoothedOver) {
  for (const double superficial : {2e-4, 0.02}) {
    for (const double diameters : {0.0, 1.5, 3.0}) {
      Bed bed{0.4, superficial, diameters * kDiameter, 14};
      const std::string what =
          fmt::format("layered, {} m/s, smoothed over {} d", superficial, diameters);
      test::expect_relative("drop over Ergun's, " + what, drop_over_ergun(bed), 1, 0.05);
      bed.scheme = CouplingScheme::smoothed;
      test::print_measured("the same smoothed", drop_over_ergun(bed), 1, 1);
    }
  }
}

/// Lift of the flow on a grain in the middle of the bed, over its submerged weight.
struct Lift {
  double superficial, share;
};
Lift lift_in_bed(const Bed& bed) {
  FrozenBed frozen(bed);
  frozen.run.advance(60);
  const FluidState& f = *frozen.run.state.fluid;
  const auto rows = host_copy(frozen.run.state.grains->kin);
  double force = 0, weight = 0;
  for (const test::NamedForce& part : frozen.run.forces()) {
    if (part.name != "force_drag" && part.name != "force_pressure_gradient") continue;
    const auto values = host_copy(part.values);
    for (std::size_t g = 0; g < rows.extent(0); ++g) {
      if (std::abs(rows(g).x.x / f.grid.dx - 14) < 2) force += values(g).x;
    }
  }
  for (std::size_t g = 0; g < rows.extent(0); ++g) {
    weight += std::abs(rows(g).x.x / f.grid.dx - 14) < 2;
  }
  weight *= 1500 * 9.81 * test::volume_of(kDiameter);
  const double superficial = test::mean_of_columns(f.u.x, f.grid, 0, 1);
  return {superficial, force / weight};
}

/// Drag and pressure gradient together reach the submerged weight at Ergun's velocity of minimum
/// fluidisation, voidage 0.4: 4.178809e-4 m/s in the table for Table II's mean grain.
TEST(PackedBed, LiftReachesTheWeightAtErgunsOnset) {
  const Lift below = lift_in_bed({0.4, 3e-4}), above = lift_in_bed({0.4, 6e-4});
  ASSERT_LT(below.share, 1);
  ASSERT_GT(above.share, 1);
  const double onset = below.superficial + (1 - below.share) / (above.share - below.share) *
                                               (above.superficial - below.superficial);
  double reference = 0;
  for (const auto& row : test::reference_table("seed_grain_derived_numbers.csv")) {
    if (test::number(row, "d") == kDiameter) reference = test::number(row, "umf_ergun");
  }
  test::expect_relative("onset of fluidisation [m/s]", onset, reference, 0.05);
}

/// A bed that floats without touching anything: once the drive carries it, it is its submerged
/// weight. The flow is held at Ergun's onset; the lattice fills the box and may move as it likes.
TEST(PackedBed, FloatingBedTakesItsSubmergedWeight) {
  const double alpha = 0.5, a = test::cubic_spacing(1 - alpha, kDiameter);
  Config c = test::water_box({4, 2, 2}, {8 * a, 4 * a, 4 * a});
  c.grains->gravity = {-9.81, 0, 0};
  c.grains->skin = 2e-5;
  c.fluid->mean_velocity = 1e-3;
  CoupledRun run(c, test::cubic_lattice({8, 4, 4}, a, kDiameter));
  run.advance(400);
  double drop = 0;
  for (int n = 0; n < 40; ++n) {
    run.advance();
    drop += 1000 * run.state.fluid->drive.x / 40;
  }
  test::expect_relative("drop of a floating bed, submerged weight [Pa/m]", drop,
                        (1 - alpha) * 1500 * 9.81, 0.01);
}

}  // namespace
}  // namespace barchan
