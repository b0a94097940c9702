// A suspension settles in a closed column: the force balance of the drag law decides how fast.
#include "tests/support/lattice.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using test::CoupledRun;

constexpr double kDiameter = 2e-4, kSubmergedWeight = 6.163805e-8;  // of Table II [m], [N]
constexpr double kAlone = 0.02291683;                               // Schiller-Naumann [m/s]

/// Force of a law on one grain at slip v and fluid fraction alpha [N].
using Law = double (*)(double v, double alpha, double d, const test::Water&);

/// Settling velocity of a suspension with no volume flux in the whole. The fluid balance,
/// alpha dp/dy = n F_d, and the grain's, F_d + V_p dp/dy = W, give F_d = alpha W; the grains move
/// with alpha times their slip, as alpha u_f + (1 - alpha) u_p = 0.
double settling_velocity(const Law& law, double alpha) {
  const double slip = test::root(
      [&](double v) { return law(v, alpha, kDiameter, {}) - alpha * kSubmergedWeight; }, 1e-9, 0.1);
  return alpha * slip;
}

/// A lattice whose upright rows are shifted against each other by parts of the spacing. The points
/// of grains at one height cross a cell face at the same moment, and the fluid has to make way for
/// all of them within a step; spread over the rows they make a steady flow.
InitialGrains staggered_lattice(int across, int high, double a) {
  InitialGrains grains;
  const int rows = across * across;
  for (int row = 0; row < rows; ++row) {
    const double shift = std::fmod(row * 0.6180339887498949, 1.0);  // golden ratio: evenly spread
    for (int j = 0; j < high; ++j) {
      test::add_grain(grains, kDiameter,
                      a * Vec3{row % across + 0.5, j + 0.5 + shift, row / across + 0.5});
    }
  }
  return grains;
}

/// Mean fall velocity of the grains in the middle of a column that they fill, over 10 ms [m/s].
double settle_column(DragLaw law, double alpha) {
  const double a = test::cubic_spacing(1 - alpha, kDiameter);
  constexpr int kAcross = 6, kHigh = 40;  // spacings; two per cell
  Config config =
      test::water_box({kAcross / 2, kHigh / 2, kAcross / 2}, {kAcross * a, kHigh * a, kAcross * a});
  config.coupling.drag = law;
  config.grains->gravity = {0, -9.81, 0};
  config.grains->skin = 2e-5;
  CoupledRun run(config, staggered_lattice(kAcross, kHigh - 1, a));
  run.advance(100);  // 25 ms: four response times of a lone grain, more in a crowd
  double sum = 0;
  int count = 0;
  for (int n = 0; n < 40; ++n) {
    run.advance();
    for (const auto& row : run.rows()) {
      if (row.x.y < 15 * a || row.x.y > 25 * a) continue;
      sum -= row.u.y;
      ++count;
    }
  }
  return sum / count;
}

void check(const char* name, DragLaw code, const Law& law, double alpha) {
  const double reference = settling_velocity(law, alpha), measured = settle_column(code, alpha);
  test::save_result("hindered_settling", {{"law", std::string(name)},
                                          {"alpha", alpha},
                                          {"v", measured},
                                          {"force_balance", reference},
                                          {"alone", kAlone}});
  const std::string claim = std::string(name) + ", alpha " + std::to_string(alpha);
  test::expect_relative(claim + ", force balance [m/s]", measured, reference, 0.02);
  test::print_measured(claim + ", Richardson-Zaki exponent",
                       std::log(measured / kAlone) / std::log(alpha), 3.821568, 1);
}

/// Gidaspow's law jumps at 0.8: Wen-Yu just above, Ergun just below.
TEST(HinderedSettling, GidaspowsForceBalance) {
  check("Gidaspow", DragLaw::of<Gidaspow>(), test::wen_yu_force, 0.9);
  check("Gidaspow", DragLaw::of<Gidaspow>(), test::wen_yu_force, 0.805);
  check("Gidaspow", DragLaw::of<Gidaspow>(), test::ergun_force, 0.795);
  check("Gidaspow", DragLaw::of<Gidaspow>(), test::ergun_force, 0.7);
}

/// Huilin & Gidaspow (2003): phi of Wen-Yu and 1 - phi of Ergun.
double blended_force(double v, double alpha, double d, const test::Water& w) {
  const double phi = std::atan(150 * 1.75 * (0.2 - (1 - alpha))) / std::numbers::pi + 0.5;
  return phi * test::wen_yu_force(v, alpha, d, w) + (1 - phi) * test::ergun_force(v, alpha, d, w);
}

TEST(HinderedSettling, BlendedForceBalanceAcrossPointEight) {
  for (const double alpha : {0.805, 0.8, 0.79}) {
    check("Gidaspow blended", DragLaw::of<GidaspowBlended>(), blended_force, alpha);
  }
}

TEST(HinderedSettling, DiFelicesForceBalance) {
  for (const double alpha : {0.9, 0.8, 0.7}) {
    check("Di Felice", DragLaw::of<DiFelice>(), test::di_felice_force, alpha);
  }
}

}  // namespace
}  // namespace barchan
