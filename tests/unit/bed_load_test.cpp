// Surface, stress and load of a bed of made-up layers, where they are known.
#include "src/diagnostics/bed_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/diagnostics/bed_load.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using std::numbers::pi;

TEST(BedLoad, ASphereIsCutIntoSlices) {
  const double r = 0.7, h = 0.3;
  const int n = 20;
  const auto below = [](double s) { return pi * (2.0 / 3 + s - s * s * s / 3); };  // of radius 1
  for (const double y : {1.234, 3.0, 0.1, 5.9}) {  // the last two reach into the floor and the lid
    double sum = 0;
    share_among_layers(y, r, h, n, [&](int k, double share) {
      sum += share;
      const double from = std::clamp((k * h - y) / r, -1.0, 1.0);
      const double to = std::clamp(((k + 1) * h - y) / r, -1.0, 1.0);
      if (k > 0 && k < n - 1) {
        EXPECT_NEAR(share, (below(to) - below(from)) / (4 * pi / 3), 1e-14) << y << " " << k;
      }
    });
    EXPECT_NEAR(sum, 1, 1e-15) << y;
  }
}

TEST(BedLoad, TheTopOfAParabola) {
  const auto parabola = [](double x) { return 5 - 3 * (x - 0.2) * (x - 0.2); };
  EXPECT_NEAR(peak_offset(parabola(-1), parabola(0), parabola(1)), 0.2, 1e-15);
  EXPECT_EQ(peak_offset(1, 1, 1), 0);
}

// A bed in which the solid fraction phi does not vary with height, with v = V exp((y - top)/s):
// P = g (rho_p - rho_f) phi (top - y), so P dv/dy is largest at a depth s below its top.
constexpr double d = 1e-3, top = 12e-3, height = 20e-3, decay = 3e-3, fastest = 0.2;
constexpr double length = 0.04, width = 0.02;
constexpr int count = 8000;

struct MadeUpBed {
  Config config = test::flow_config({8, 10, 4}, {length, height, width}, 0);
  Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid);
  BedLoad::Surroundings around{.fluid_density = 1000, .viscosity = 1e-6, .gravity = {0, -9.81, 0}};

  /// Grains of two sizes and, if asked for, two densities that give the same mean everywhere.
  static GrainState grains(double speed, bool of_two_kinds) {
    InitialGrains table;
    for (int g = 0; g < count; ++g) {
      const double size = g % 2 == 0 ? 1.1 * d : 0.9 * d;
      const double y = size / 2 + (g + 0.5) / count * (top - size);
      table.add(g + 1, size, {std::fmod(0.618034 * g, 1.0) * length, y, 0.5 * width},
                {speed * std::exp((y - top) / decay), 0, 0});
      if (of_two_kinds) table.kind.push_back(static_cast<std::uint8_t>(g / 2 % 2));
    }
    if (of_two_kinds) table.kind_names = {"light", "heavy"};
    const std::vector<Real> density =
        of_two_kinds ? std::vector<Real>{2000, 3000} : std::vector<Real>{2500};
    return make_grain_state(table, density);
  }

  /// A flow u = u_0 + rate y, with a lid that goes on with it.
  void set_flow(double u_0, double rate) {
    config.fluid->top = WallFlow::no_slip;
    config.fluid->top_velocity = u_0 + rate * height;
    test::set_faces(fluid.u, grid, [&](std::size_t axis, double, double y, double) {
      return axis == 0 ? u_0 + rate * y : 0;
    });
    FluidSolver(config, grid).fill_ghosts(fluid);
  }
};

/// The same bed exactly, below its last diameter. The centres of grains of a size lie evenly
/// between floor and top, so as a mean these fill a part of the volume up to half a diameter below
/// the top.
struct ExactBed {
  double volume = 0;                  // of all grains [m^3]
  double fraction = 0, mean_top = 0;  // [-], [m]
  ExactBed() {
    for (const double size : {1.1 * d, 0.9 * d}) {
      const double of_size = count / 2 * pi / 6 * size * size * size;
      const double share = of_size / (length * width * (top - size));
      volume += of_size, fraction += share, mean_top += share * (top - size / 2);
    }
    mean_top /= fraction;
  }
};

TEST(BedLoad, SurfaceStressAndLoadOfAKnownBed) {
  for (const bool of_two_kinds : {false, true}) {
    SCOPED_TRACE(of_two_kinds);
    MadeUpBed bed;
    bed.set_flow(0.01, 5);
    bed.fluid.drive = {0.02, 0};
    BedLoad load(bed.around, bed.grid);
    load.sample(bed.fluid, MadeUpBed::grains(fastest, of_two_kinds), 1);
    load.sample(bed.fluid, MadeUpBed::grains(fastest, of_two_kinds), 2);
    const auto lines = load.table();
    ASSERT_EQ(lines.size(), 80u);
    const BedLoadRecord& all = lines[7];
    EXPECT_NEAR(all.d, d, 1e-12);
    EXPECT_EQ(all.n_samples, 2);
    EXPECT_EQ(all.t_start, 1);
    EXPECT_EQ(all.t_end, 2);
    // A parabola through points d/4 apart finds the top of x exp(-x/s) to (d/4)^2/(3 s) = 0.007 d.
    const ExactBed exact;
    const double surface = exact.mean_top - decay;
    test::expect_absolute("surface of a made-up bed (d)", all.bed_surface / d, surface / d, 0.025);
    const double stress = 1e-6 * 1000 * 5 + 1000 * 0.02 * (height - surface);
    EXPECT_NEAR(all.bed_stress, stress, 1000 * 0.02 * 0.025 * d);
    EXPECT_NEAR(all.shields, all.bed_stress / (1500 * 9.81 * d), 1e-9);
    const double mass = 2500 * exact.fraction * decay;
    EXPECT_NEAR(all.load, mass, 0.025 * d / decay * mass);
    // q: the sum over the grains, exactly.
    double q = 0;
    const auto kin = host_copy(MadeUpBed::grains(fastest, false).kin);
    for (int g = 0; g < count; ++g) q += 4 * pi / 3 * std::pow(kin(g).r, 3) * kin(g).u.x;
    q /= length * width;
    EXPECT_NEAR(all.q, q, 1e-12 * q);
    EXPECT_NEAR(all.q_star, q / std::sqrt(1.5 * 9.81 * d * d * d), 1e-9 * all.q_star);
    EXPECT_NEAR(all.load_velocity, 2500 * q / all.load, 1e-3 * all.load_velocity);
    double sum = 0, weight = 0;
    for (const BedLoadRecord& line : lines) {
      sum += line.flux_density * height / 80;
      weight += line.solid_fraction * 1500 * 9.81 * height / 80;
      EXPECT_EQ(line.bed_surface, all.bed_surface);
      EXPECT_EQ(line.production, line.particle_pressure * line.shear_rate);
      EXPECT_NEAR(line.total_stress, 1e-6 * 1000 * 5 + 1000 * 0.02 * (height - line.y), 1e-12);
    }
    EXPECT_NEAR(sum, q, 1e-12 * q);
    EXPECT_NEAR(lines[0].particle_pressure, weight, 0.01 * weight) << "half a layer less";
    // In the bulk the shear rate is that of the profile, smeared over a sphere: 2 % at d/3 of s.
    EXPECT_NEAR(lines[24].shear_rate, fastest / decay * std::exp((lines[24].y - top) / decay),
                0.02 * lines[24].shear_rate);
  }
}

TEST(BedLoad, AFlowUpstreamHasTheSameSurface) {
  MadeUpBed bed;
  BedLoad there(bed.around, bed.grid), back(bed.around, bed.grid);
  bed.fluid.drive = {0.02, 0};
  there.sample(bed.fluid, MadeUpBed::grains(fastest, false), 1);
  bed.fluid.drive = {-0.02, 0};
  back.sample(bed.fluid, MadeUpBed::grains(-fastest, false), 1);
  const BedLoadRecord one = there.table()[0], other = back.table()[0];
  EXPECT_EQ(one.bed_surface, other.bed_surface);
  EXPECT_EQ(one.shields, -other.shields);
  EXPECT_EQ(one.q_star, -other.q_star);
}

TEST(BedLoad, StressOfAFlowThatSpeedsUp) {
  // Pressure alone accelerates all fluid alike: it leaves no stress at any height.
  MadeUpBed bed;
  BedLoad load(bed.around, bed.grid);
  const GrainState at_rest = MadeUpBed::grains(0, false);
  bed.fluid.drive = {0.5, 0};
  for (const double t : {1.0, 1.4, 2.0}) {
    bed.set_flow(0.5 * t, 0);
    load.sample(bed.fluid, at_rest, t);
  }
  const auto lines = load.table();
  for (const BedLoadRecord& line : lines) {
    EXPECT_NEAR(line.total_stress, 0, 1e-9);
    EXPECT_EQ(line.production, 0);
  }
  EXPECT_TRUE(std::isnan(lines[0].bed_surface) && std::isnan(lines[0].shields));
  EXPECT_EQ(lines[0].q, 0);
}

TEST(BedLoad, OnASlopeTheWeightOfGrainsPulls) {
  MadeUpBed bed;
  bed.around.gravity = {0.3, -9.8, 0};
  BedLoad load(bed.around, bed.grid);
  load.sample(bed.fluid, MadeUpBed::grains(fastest, false), 0);
  for (const BedLoadRecord& line : load.table())
    EXPECT_NEAR(line.total_stress, 0.3 / 9.8 * line.particle_pressure, 1e-9);
}

TEST(BedLoad, NothingWithoutGrains) {
  const TemporaryFolder folder;
  MadeUpBed bed;
  BedLoad load(bed.around, bed.grid);
  load.sample(bed.fluid, make_grain_state(InitialGrains(), Real(2500)), 1);
  load.write(folder / "bedload.csv");
  EXPECT_FALSE(std::filesystem::exists(folder / "bedload.csv"));
}

}  // namespace
}  // namespace barchan
