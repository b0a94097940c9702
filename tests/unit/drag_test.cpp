// Drag laws against the reference table and their limits.
#include <gtest/gtest.h>

#include "src/case/config.hpp"
#include "tests/support/reference_table.hpp"

namespace barchan {
namespace {

LocalFlow water(Real alpha, Real slip, Real d = 2e-4) {
  return {.alpha_f = alpha, .rho_f = 1000, .mu_f = 1e-3, .slip = slip, .d_p = d};
}

TEST(Drag, MatchesTheReferenceTable) {
  const auto rows = test::reference_table("drag_law_comparison.csv");
  EXPECT_GE(rows.size(), 18u);
  for (const auto& row : rows) {
    const Real u = test::number(row, "u"), alpha = test::number(row, "alpha");
    const auto check = [&](const auto& law, const char* column) {
      EXPECT_NEAR(law(water(alpha, u)) * u / test::number(row, column), 1, 1e-3)
          << column << " at u " << u << ", alpha " << alpha;
    };
    check(Gidaspow{}, "gidaspow_cfdem");
    check(DiFelice{}, "difelice");
    check(KochHill{}, "koch_hill");
    check(SyamlalOBrien{}, "syamlal_obrien");
    check(PaperRepaired{}, "wenyu_with_SO_cd");
  }
}

TEST(Drag, IsFiniteAtZeroSlipAndStokesWhenAlone) {
  const Real stokes = 3 * std::numbers::pi_v<Real> * 1e-3 * 2e-4;
  EXPECT_NEAR(SchillerNaumann{}(water(1, 0)), stokes, 1e-12 * stokes);
  EXPECT_NEAR(Gidaspow{}(water(1, 0)), stokes, 1e-12 * stokes);
  EXPECT_NEAR(Beetstra{.d_mean = 2e-4}(water(1, 0)), stokes * 1.064, 1e-4 * stokes);
  for (const DragLaw choice : DragLaw::all()) {
    const auto law = DragLaws::make(choice, Real(2e-4));
    for (const Real alpha : {0.4, 0.7, 0.9, 1.0}) {
      const Real beta = std::visit([&](const auto& l) { return l(water(alpha, 0)); }, law);
      EXPECT_TRUE(std::isfinite(beta)) << choice.word() << ' ' << alpha;
      EXPECT_EQ(beta > 0, !choice.is<NoDrag>()) << choice.word() << ' ' << alpha;
    }
  }
}

// Beetstra et al. at Re -> 0 are van der Hoef et al. (2005): F = 10 s/a^2 + a^2 (1 + 1.5 sqrt(s))
// in units of Stokes drag at the superficial slip a (u_f - u). In a mixture a grain of y mean
// diameters feels a y + s y^2 + 0.064 a y^3 of it.
TEST(Drag, BeetstraInSlowFlowIsVanDerHoefs) {
  const Real stokes = 3 * std::numbers::pi_v<Real> * 1e-3 * 2e-4, a = 0.5;
  const Real f = 10 * 0.5 / 0.25 + 0.25 * (1 + 1.5 * std::sqrt(0.5));
  const auto beta = [](Real d) { return Beetstra{.d_mean = 2e-4}(water(0.5, 0, d)); };
  EXPECT_NEAR(beta(2e-4) / (stokes * a * f * (1 + 0.064 * a)), 1, 1e-6);
  EXPECT_NEAR(beta(3e-4) / beta(2e-4), (0.75 + 0.5 * 2.25 + 0.032 * 3.375) / 1.032, 1e-12);
}

// Huilin & Gidaspow (2003): half of each at alpha_f = 0.8, where "gidaspow" jumps; by then the
// slope of the share is 150 * 1.75/pi.
TEST(Drag, BlendsErgunAndWenYuAcrossPointEight) {
  const auto share = [](Real alpha) {
    const LocalFlow flow = water(alpha, 0.05);
    return (GidaspowBlended{}(flow)-ergun(flow)) / (wen_yu(flow) - ergun(flow));
  };
  EXPECT_NEAR(share(0.8), 0.5, 1e-12);
  EXPECT_NEAR((share(0.8001) - share(0.7999)) / 2e-4, 262.5 / std::numbers::pi, 0.1);
  EXPECT_NEAR(share(0.7), 1 - share(0.9), 1e-9);
  for (const Real alpha : {0.4, 0.6, 0.95, 1.0}) {
    const LocalFlow flow = water(alpha, 0.05);
    EXPECT_NEAR(GidaspowBlended{}(flow) / Gidaspow{}(flow), 1, 0.01) << alpha;
  }
  // Across 0.8 it goes on where "gidaspow" jumps.
  const auto jump = [](const auto& law) {
    return law(water(0.800001, 0.05)) / law(water(0.8, 0.05));
  };
  EXPECT_GT(std::abs(jump(Gidaspow{}) - 1), 0.03);
  EXPECT_NEAR(jump(GidaspowBlended{}), 1, 1e-3);
}

TEST(Drag, VelocityRatioIsOneForALoneGrain) {
  for (const Real reynolds : {0.01, 1.0, 100.0}) {
    EXPECT_NEAR(terminal_velocity_ratio(1, reynolds), 1, 1e-12);
  }
}

TEST(Drag, GrowsWithCrowdingAndSlip) {
  for (const Real u : {0.01, 0.1}) {
    EXPECT_GT(Gidaspow{}(water(0.5, u)), Gidaspow{}(water(0.7, u)));
    EXPECT_GT(Gidaspow{}(water(0.85, u)), Gidaspow{}(water(0.95, u)));
    EXPECT_GT(Beetstra{.d_mean = 2e-4}(water(0.5, u)), Beetstra{.d_mean = 2e-4}(water(0.9, u)));
  }
  EXPECT_GT(Gidaspow{}(water(0.5, 0.2)), Gidaspow{}(water(0.5, 0.1)));
}

}  // namespace
}  // namespace barchan
