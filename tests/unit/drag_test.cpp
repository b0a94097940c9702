// Drag laws against the reference table and their limits.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "kernels/coupling/drag.hpp"

namespace barchan {
namespace {

LocalFlow water(Real alpha, Real slip, Real d = 2e-4) {
  return {.alpha_f = alpha, .rho_f = 1000, .mu_f = 1e-3, .slip = slip, .d_p = d};
}

TEST(Drag, MatchesTheReferenceTable) {
  std::ifstream file(BARCHAN_SOURCE_DIR "/tests/reference/drag_law_comparison.csv");
  ASSERT_TRUE(file);
  std::string line;
  int rows = 0;
  while (std::getline(file, line)) {
    if (line[0] == '#' || line[0] == 'u') continue;
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream in(line);
    Real u, alpha, gidaspow, di_felice, koch_hill, syamlal, repaired;
    in >> u >> alpha >> gidaspow >> di_felice >> koch_hill >> syamlal >> repaired;
    const LocalFlow flow = water(alpha, u);
    EXPECT_NEAR(Gidaspow{}(flow)*u / gidaspow, 1, 1e-3) << line;
    EXPECT_NEAR(DiFelice{}(flow)*u / di_felice, 1, 1e-3) << line;
    EXPECT_NEAR(KochHill{}(flow)*u / koch_hill, 1, 1e-3) << line;
    EXPECT_NEAR(SyamlalOBrien{}(flow)*u / syamlal, 1, 1e-3) << line;
    EXPECT_NEAR(PaperRepaired{}(flow)*u / repaired, 1, 1e-3) << line;
    ++rows;
  }
  EXPECT_GE(rows, 18);
}

TEST(Drag, IsFiniteAtZeroSlipAndStokesWhenAlone) {
  const Real stokes = 3 * std::numbers::pi_v<Real> * 1e-3 * 2e-4;
  EXPECT_NEAR(SchillerNaumann{}(water(1, 0)), stokes, 1e-12 * stokes);
  EXPECT_NEAR(Gidaspow{}(water(1, 0)), stokes, 1e-12 * stokes);
  EXPECT_NEAR(Beetstra{.d_mean = 2e-4}(water(1, 0)), stokes * 1.064, 1e-4 * stokes);
  for (const Real alpha : {0.4, 0.7, 0.9, 1.0}) {
    const LocalFlow flow = water(alpha, 0);
    for (const Real beta :
         {Gidaspow{}(flow), DiFelice{}(flow), KochHill{}(flow), SyamlalOBrien{}(flow),
          PaperRepaired{}(flow), Beetstra{.d_mean = 2e-4}(flow)}) {
      EXPECT_TRUE(std::isfinite(beta) && beta > 0) << alpha;
    }
  }
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
