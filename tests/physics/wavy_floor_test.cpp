// A floor of sine shape under a flow across its crests.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr double kWavelength = 0.01, kNu = 1e-4, kLid = 1e-4;  // [m], [m^2/s], [m/s]
constexpr double kWaveNumber = 2 * std::numbers::pi / kWavelength, kAmplitude = 0.4 / kWaveNumber;

/// Height above its mean at which a flat floor would hold a slow shear as this one does, times k;
/// `n` cells to a wavelength, the crests shifted by a part of a cell.
double measured_shift(int n, double shift) {
  const double h = kWavelength / n;
  const double base = 2.3 * h;  // above the floor, on which nothing acts then
  const int rows = n + static_cast<int>(std::ceil((base + 2 * kAmplitude) / h));
  Config config = laminar({n, rows, 1}, {kWavelength, rows * h, h}, kNu, 1e-8);
  config.fluid->top = WallFlow::no_slip;
  config.fluid->top_velocity = kLid;
  BodyConfig wave;
  wave.name = "wave";
  wave.shape = BodyShape::of<shapes::Wave>();
  wave.centre = {shift * h, 0};
  wave.base = base;
  wave.height = 2 * kAmplitude;
  wave.wavelength = kWavelength;
  config.bodies = {wave};
  FlowRun run(config);
  const double mean = base + kAmplitude, depth = rows * h - mean;
  run.start([&](int, int j, int) { return kLid * std::max(0., run.h.y(j) - mean) / depth; });
  run.solver.flow_around_bodies(run.fluid);
  const double dt = 0.08 * h * h / kNu;
  const auto stress = [&] {
    return run.solver.body_loads()[0].force.x / (run.grid.lx * run.grid.lz);
  };
  double before = 0, now = 1;
  const auto changes = [&] { return std::abs(now - before) / std::abs(now); };
  for (int part = 0; part < 500 && changes() > 1e-6; ++part) {
    before = now;
    for (int s = 0; s < 200; ++s) run.advance(dt);
    now = stress();
  }
  EXPECT_LT(changes(), 1e-6) << "not steady";
  return kWaveNumber * (depth - 1000 * kNu * kLid / now);
}

// Theory: to second order in k a the shift is (k a)^2 (Tuck & Kouzoubov, J. Fluid Mech. 300, 59,
// 1995), and, with sixteen modes e^(-n k y) that meet no slip on the wave by least squares,
// 0.143656 for k a = 0.4.
TEST(WavyFloor, HoldsASlowShearAsAFlatOneAboveItsMean) {
  double worst[2] = {};
  for (const int fine : {0, 1}) {
    for (const double shift : {0.0, 0.37}) {
      const double found = measured_shift(fine ? 32 : 16, shift);
      std::printf("[ measured ] wave, %d cells, shifted by %.2f: k times its shift %.4f\n",
                  fine ? 32 : 16, shift, found);
      worst[fine] = std::max(worst[fine], std::abs(found / 0.143656 - 1));
    }
  }
  expect_below("shift of a wavy floor, 32 cells to a wave: error", worst[1], 0.01);
  EXPECT_LT(worst[1], worst[0]);
}

}  // namespace
}  // namespace barchan
