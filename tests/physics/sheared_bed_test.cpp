// Steady shear over a held bed: forces on each layer of grains, and the fluid between them.
#include <fmt/format.h>

#include <random>

#include "tests/support/coupled_run.hpp"
#include "tests/support/drag_reference.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

constexpr double kDiameter = 2e-4, kSolid = 0.6, kMu = 1e-3;
constexpr int kLayers = 5;
constexpr double kBed = kLayers * kDiameter, kHeight = 1.8e-3;  // [m], the lid is 0.8 mm above
constexpr double kWeight = 1500 * 9.81;                         // submerged, per volume [N/m^3]

/// Force of the flow along x on each layer over its submerged weight, the lowest first; stress on
/// the bed [Pa]; the slowest row of fluid [m/s].
struct Layers {
  std::array<double, kLayers> force{};
  double stress = 0, slowest = 0;
};

/// Reference column in one dimension, on many rows: mu u'' = beta u, no slip at the floor, u = lid
/// at the top, solid fraction 0.6 up to kBed; drag of Ergun, Wen & Yu above alpha 0.8.
Layers reference_column(double lid) {
  constexpr int n = 900;
  constexpr double dy = kHeight / n;
  const auto solid = [](int j) { return (j + 0.5) * dy < kBed ? kSolid : 0.0; };
  const auto drag = [&](int j, double u) {  // per volume and velocity [kg/(m^3 s)]
    const double volume = test::volume_of(kDiameter), speed = std::max(std::abs(u), 1e-12);
    return solid(j) > 0 ? kSolid / volume * test::ergun_force(speed, 1 - kSolid, kDiameter) / speed
                        : 0;
  };
  std::vector<double> u(n, 0.0), upper(n), right(n);
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double c = kMu / (dy * dy);
    std::vector<double> next(n);
    for (int j = 0; j < n; ++j) {  // Thomas
      const double low = j > 0 ? c : 2 * c, high = j + 1 < n ? c : 2 * c;
      const double diagonal = low + high + drag(j, u[std::size_t(j)]);
      const double rhs = j + 1 < n ? 0 : 2 * c * lid;
      const double below = j > 0 ? c : 0,
                   pivot = diagonal - (j > 0 ? below * upper[std::size_t(j - 1)] : 0);
      upper[std::size_t(j)] = (j + 1 < n ? c : 0) / pivot;
      right[std::size_t(j)] = (rhs + (j > 0 ? below * right[std::size_t(j - 1)] : 0)) / pivot;
    }
    for (int j = n - 1; j >= 0; --j) {
      const auto s = std::size_t(j);
      next[s] = right[s] + (j + 1 < n ? upper[s] * next[s + 1] : 0);
    }
    for (std::size_t s = 0; s < n; ++s) u[s] = 0.5 * (u[s] + next[s]);
  }
  Layers result{.stress = kMu * (lid - u[n - 1]) / (dy / 2)};
  for (int j = 0; (j + 1) * dy <= kBed * (1 + 1e-9); ++j) {
    result.force[std::size_t((j + 0.5) * dy / kDiameter)] +=
        drag(j, u[std::size_t(j)]) * u[std::size_t(j)] * dy;
  }
  for (double& layer : result.force) layer /= kSolid * kDiameter * kWeight;
  return result;
}

// The bed repeats every half cell: so each momentum cell of a row holds the same grains, and the
// flow is that of the column. In an uneven bed it winds through the open places.
constexpr int kRepeats = 4, kInPatch = 5;  // along x and z; grains of a layer in one
const double kPatch = std::sqrt(kInPatch * test::volume_of(kDiameter) / (kSolid * kDiameter));
const double kWidth = kRepeats * kPatch;  // [m]

/// Grains anywhere in their layer, the lowest on the floor: they are held and may overlap. Where
/// z is above `step` there are three layers.
InitialGrains random_bed(int repeats_z = kRepeats, double step = 1) {
  std::mt19937_64 generator(1);
  const auto uniform = [&generator] { return static_cast<double>(generator() >> 11) * 0x1.0p-53; };
  InitialGrains grains;
  for (int layer = 0; layer < kLayers; ++layer) {
    for (int g = 0; g < kInPatch; ++g) {
      const double low = layer == 0 ? 0.5 : 0.0;
      const double y = kDiameter * (layer + low + (1 - low) * uniform());
      const double x = kPatch * uniform(), z = kPatch * uniform();
      for (int a = 0; a < kRepeats * repeats_z; ++a) {
        const Vec3 at{x + kPatch * (a % kRepeats), y, z + kPatch * (a / kRepeats)};
        if (layer < 3 || at.z < step) test::add_grain(grains, kDiameter, at);
      }
    }
  }
  return grains;
}

/// A channel over a held bed, cells 4 d wide.
Config held_bed(CouplingScheme scheme, int rows, double smoothing) {
  Config c = test::water_box({2, rows, 2}, {kWidth, kHeight, kWidth});
  c.fluid->bottom = WallFlow::no_slip;
  c.grains->frozen = true;
  c.coupling.scheme = scheme;
  c.coupling.smoothing_length = smoothing;
  c.time.fluid_step = 1e-3;
  return c;
}

Layers program(CouplingScheme scheme, int rows, double smoothing, double lid) {
  Config c = held_bed(scheme, rows, smoothing);
  c.fluid->top = WallFlow::no_slip;
  c.fluid->top_velocity = lid;
  test::CoupledRun run(c, random_bed());
  run.advance(1500);
  const FluidState& f = *run.state.fluid;
  const test::HostField u = test::to_host(f.u.x);
  std::vector<double> row(std::size_t(rows), 0.0);
  test::for_owned_cells(f.grid, [&](int i, int j, int k) {
    row[std::size_t(j)] += u(i, j, k) / (f.grid.nx * f.grid.nz);
  });
  Layers result{.slowest = *std::min_element(row.begin(), row.end())};
  result.stress = kMu * (lid - row.back()) / (kHeight / rows / 2);
  const auto kin = host_copy(run.state.grains->kin);
  std::array<double, kLayers> count{};
  for (const test::NamedForce& force : run.forces()) {
    if (force.name == "force_total" || force.name.starts_with("force_contact")) continue;
    const auto values = host_copy(force.values);
    for (std::size_t g = 0; g < values.extent(0); ++g) {
      const auto layer = std::size_t(std::min(kin(g).x.y / kDiameter, kLayers - 0.5));
      result.force[layer] += values(g).x / (kWeight * test::volume_of(kDiameter));
      count[layer] += force.name == "force_drag";
    }
  }
  for (std::size_t layer = 0; layer < kLayers; ++layer) result.force[layer] /= count[layer];
  return result;
}

void print(const std::string& what, const Layers& layers) {
  std::printf("[ measured ] %s: force over weight by layer", what.c_str());
  for (const double force : layers.force) std::printf(" %.4f", force);
  std::printf(", stress %.4f Pa, slowest row %.3g mm/s\n", layers.stress, 1e3 * layers.slowest);
}

/// No row of fluid between the grains ever flows against the flow above, no layer is pushed
/// upstream, and the top layer gets what a column on many rows gives it: on the rows of the shipped
/// cases and finer ones, for every smoothing of the void fraction.
TEST(ShearedBed, WaterInTheBedIsNotDrivenBackwards) {
  constexpr double lid = 0.26;
  const Layers column = reference_column(lid);
  print("column of 900 rows", column);
  for (const int rows : {6, 7, 9}) {
    for (const double smoothing : {0.0, 3e-4, 6e-4}) {
      const Layers bed = program(CouplingScheme::layered, rows, smoothing, lid);
      const std::string what =
          fmt::format("{} rows, smoothed over {:.1f} d", rows, smoothing / kDiameter);
      print(what, bed);
      test::expect_below("row that flows backwards over the lid, " + what, -bed.slowest / lid,
                         1e-8);
      test::expect_below("layer pushed upstream over its weight, " + what,
                         -*std::min_element(bed.force.begin(), bed.force.end()), 1e-4);
      test::expect_relative("force on the top layer over the stress, " + what,
                            bed.force.back() / bed.stress, column.force.back() / column.stress,
                            0.2);
    }
  }
}

/// A bed with a step: beside the flow over the lower half lie grains of the higher one. None is
/// pushed upstream, and nowhere does fluid flow backwards, though it flows fast in the same row two
/// cells away.
TEST(ShearedBed, WaterBesideAStepIsNotDrivenBackwards) {
  constexpr double lid = 0.26;
  for (const double smoothing : {0.0, 6e-4}) {
    Config c = held_bed(CouplingScheme::layered, 9, smoothing);
    c.size[2] = 2 * kWidth;
    c.fluid->cells[2] = 4;
    c.fluid->top = WallFlow::no_slip;
    c.fluid->top_velocity = lid;
    test::CoupledRun run(c, random_bed(2 * kRepeats, kWidth));
    run.advance(1500);
    const test::HostField u = test::to_host(run.state.fluid->u.x);
    double slowest = lid, least = 1, most = 0;
    test::for_owned_cells(run.state.fluid->grid, [&](int i, int j, int k) {
      slowest = std::min(slowest, u(i, j, k));
      if (j == 4) most = std::max(most, u(i, j, k));
    });
    for (const test::NamedForce& force : run.forces()) {
      if (force.name != "force_drag") continue;
      const auto values = host_copy(force.values);
      for (std::size_t g = 0; g < values.extent(0); ++g) least = std::min(least, values(g).x);
    }
    const std::string what = fmt::format(", smoothed over {:.1f} d", smoothing / kDiameter);
    test::expect_below("water that flows backwards over the lid" + what, -slowest / lid, 1e-8);
    test::expect_below("grain dragged upstream over its weight" + what,
                       -least / (kWeight * test::volume_of(kDiameter)), 1e-4);
    EXPECT_GT(most, 0.1 * lid) << "there is no step";
  }
}

/// Eight by eight grains a layer, one above the other; in 8 x 8 cells each between two faces of u.
InitialGrains regular_bed() {
  constexpr int n = 8;
  InitialGrains grains;
  for (int g = 0; g < kLayers * n * n; ++g) {
    const int layer = g / (n * n);
    test::add_grain(
        grains, kDiameter,
        {kWidth / n * (g % n + 0.5), kDiameter * (layer + 0.5), kWidth / n * (g / n % n + 0.5)});
  }
  return grains;
}

/// Each grain joins the fluid of two momentum cells in 8 x 8 cells; in 6 x 6 more than twice as
/// many grains belong to some momentum cells as lie there. However strong their drag, no velocity
/// overshoots: the flow becomes steady.
TEST(ShearedBed, InCellsAsWideAsAGrainStrongDragIsStable) {
  constexpr double lid = 0.01;
  for (const int cells : {6, 8}) {
    Config c = held_bed(CouplingScheme::layered, 9, 0);
    c.fluid->cells = {cells, 9, cells};
    c.fluid->top = WallFlow::no_slip;
    c.fluid->top_velocity = lid;
    test::CoupledRun run(c, regular_bed());
    const auto fastest = [&run] {
      const test::HostField u = test::to_host(run.state.fluid->u.x);
      double most = 0;
      test::for_owned_cells(run.state.fluid->grid, [&](int i, int j, int k) {
        most = std::max(most, std::abs(u(i, j, k)));
      });
      return most;
    };
    run.advance(10);
    double most = 0;
    for (int step = 0; step < 1500; ++step) {
      run.advance(1);
      most = std::max(most, fastest());
    }
    const double before = fastest();
    run.advance(1);
    const std::string what = fmt::format(", {0} x {0} cells", cells);
    test::expect_below("fastest water over the lid" + what, most / lid, 1);
    test::expect_below("its change in a step over the lid" + what,
                       std::abs(fastest() - before) / lid, 1e-6);
  }
}

/// The drive of a steady flow ends in the grains and in the floor, nowhere else.
TEST(ShearedBed, ForceOnGrainsAndFloorIsTheDrive) {
  constexpr double gradient = 300;  // [Pa/m]
  for (const double smoothing : {0.0, 3e-4, 6e-4}) {
    Config c = held_bed(CouplingScheme::layered, 7, smoothing);
    c.fluid->pressure_gradient = gradient;
    test::CoupledRun run(c, random_bed());
    run.advance(6000);
    double on_grains = 0;
    for (const test::NamedForce& force : run.forces()) {
      if (force.name == "force_total" || force.name.starts_with("force_contact")) continue;
      const auto values = host_copy(force.values);
      for (std::size_t g = 0; g < values.extent(0); ++g) on_grains += values(g).x;
    }
    const double u_star = run.step.fluid_solver()->friction_velocity(*run.state.fluid);
    const double floor = 1000 * u_star * u_star * kWidth * kWidth;
    const std::string what = fmt::format(", smoothed over {:.1f} d", smoothing / kDiameter);
    test::expect_relative("force on grains and floor over the drive" + what,
                          (on_grains + floor) / (gradient * kWidth * kHeight * kWidth), 1, 1e-6);
    EXPECT_GT(floor, 0);
    test::expect_relative("that force in the accounts" + what,
                          run.step.impulse_on_grains().x / c.time.fluid_step, on_grains, 1e-9);
    test::expect_below("pressure and stress: grains against flow" + what,
                       run.step.ledger().entries().at("largest_flow_force_mismatch"), 1e-10);
  }
}

}  // namespace
}  // namespace barchan
