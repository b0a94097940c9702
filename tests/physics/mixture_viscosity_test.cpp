// Viscosity of a suspension between two walls, against Boyer, Guazzelli & Pouliquen (2011).
#include <random>

#include "tests/support/coupled_run.hpp"
#include "tests/support/drag_reference.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using test::CoupledRun;

constexpr double kD = 2e-4, kSide = 4e-3, kLow = 1e-3, kHigh = 3e-3;  // [m]

/// Grains between two heights in a box of kSide, none within a diameter of another.
InitialGrains suspension(double solid_fraction) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> across(0, kSide), up(kLow, kHigh);
  const double wanted = solid_fraction * kSide * kSide * (kHigh - kLow) / test::volume_of(kD);
  std::vector<Vec3> centres;
  InitialGrains grains;
  while (double(centres.size()) < wanted) {
    const Vec3 at{across(random), up(random), across(random)};
    const auto touches = [&](const Vec3& other) {
      const Vec3 off = at - other;
      const auto nearest = [](double x) { return x - kSide * std::round(x / kSide); };
      return norm(Vec3{nearest(off.x), off.y, nearest(off.z)}) < 1.05 * kD;
    };
    if (std::ranges::any_of(centres, touches)) continue;
    centres.push_back(at);
    test::add_grain(grains, kD, at);
  }
  return grains;
}

/// Mean shear [1/s] between two heights.
double shear_between(const CoupledRun& run, double low, double high) {
  const Grid& grid = run.state.fluid->grid;
  const test::HostGrid h(grid);
  const auto u = test::to_host(run.state.fluid->u.x);
  std::vector<double> at, mean;
  for (int j = 0; j < grid.ny; ++j) {
    if (h.y(j) < low || h.y(j) > high) continue;
    double sum = 0;
    for (int i = 0; i < grid.nx; ++i)
      for (int k = 0; k < grid.nz; ++k) sum += u(i, j, k);
    at.push_back(h.y(j)), mean.push_back(sum / (grid.nx * grid.nz));
  }
  return (mean.back() - mean.front()) / (at.back() - at.front());
}

/// Stress over viscosity and shear in the middle of the suspension, in steady flow.
double relative_viscosity(double solid_fraction, bool of_mixture) {
  Config c = test::water_box({2, 30, 2}, {kSide, kSide, kSide});
  c.fluid->kinematic_viscosity = 1e-4;
  c.fluid->bottom = c.fluid->top = WallFlow::no_slip;
  c.fluid->top_velocity = 4e-3;
  c.grains->density = 1000;
  c.coupling.forces.mixture_viscosity = of_mixture;
  c.time.fluid_step = 1.25e-5;
  CoupledRun run(c, suspension(solid_fraction));
  run.advance(2500);
  const double clear =
      (shear_between(run, 0, kLow - kD) + shear_between(run, kHigh + kD, kSide)) / 2;
  return clear / shear_between(run, kLow + 2 * kD, kHigh - 2 * kD);
}

TEST(MixtureViscosity, IsThatOfASuspension) {
  for (const double phi : {0.1, 0.2}) {
    const double with = relative_viscosity(phi, true), without = relative_viscosity(phi, false);
    std::printf("[ measured ] solid fraction %.1f: viscosity %.3f, by drag alone %.3f\n", phi, with,
                without);
    test::expect_relative("relative viscosity", with, 1 + 2.5 * phi / (1 - phi / 0.585), 0.05);
    EXPECT_LT(without, 1 + 2.5 * phi);
  }
}

}  // namespace
}  // namespace barchan
