// Particle impacts of Chung & Ooi, Granular Matter 13, 643 (2011). Materials and curves are in
// tests/reference/dem_chung_ooi2011_*.csv. Spinning and oblique impacts: chung_ooi_spin_test.cpp.
#include "tests/support/grain_impact.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using namespace testing;

/// A row of the table of materials; ranges (test 3) are given by their lower end.
struct Parameters {
  std::string material;
  ImpactCase impact;
};

/// The row of a test for a material.
Parameters parameters(const std::string& test, const std::string& material) {
  for (const auto& cells : reference_rows("dem_chung_ooi2011_parameters.csv")) {
    if (cells[0] != test || cells[2] != material) continue;
    const auto q = numbers(cells, 3);
    const bool rigid = q[7] == 1;
    ImpactCase c{.material = {.youngs_modulus = q[0],
                              .poisson_ratio = q[1],
                              .restitution = q[3],
                              .sliding_friction = q[2]},
                 .wall_modulus = kRigid,
                 .density = q[4],
                 .radius = q[5],
                 .v = rigid ? q[6] : 2 * q[6],
                 .on_wall = rigid};
    return {material, c};
  }
  throw std::runtime_error("no parameters of test " + test + " for " + material);
}

/// Duration of an elastic contact (Hertz) [s].
Real hertz_duration(const ImpactCase& c) {
  return 2.8683 * std::pow(c.m_eff() * c.m_eff() / (c.r_eff() * c.e_eff() * c.e_eff() * c.v), 0.2);
}

/// Force at an overlap on the loading branch, between two steps [N].
Real force_at(const std::vector<ImpactSample>& loading, Real overlap) {
  ImpactSample before;
  for (const ImpactSample& s : loading) {
    if (s.overlap >= overlap) {
      const Real part = (overlap - before.overlap) / (s.overlap - before.overlap);
      return before.force + part * (s.force - before.force);
    }
    before = s;
  }
  return before.force;  // beyond the largest overlap
}

/// Loading branch against the digitised one. The tolerance, 2 %, is of the largest force: the
/// digitising error does not shrink with the force.
void expect_loading_branch(const std::string& number, const std::string& material) {
  const ImpactCase c = parameters(number, material).impact;
  const ImpactResult impact = run_impact(c, hertz_duration(c) / 1000);
  Real worst = 0, worst_at = 0;
  for (const auto& cells : reference_rows("dem_chung_ooi2011_test1_test2_force_overlap.csv")) {
    const auto q = numbers(cells);
    if (cells[0] != number) continue;
    const Real overlap = 1e-6 * q[1];
    if (overlap > impact.max_overlap) {  // the curve's end may overshoot by the digitising error
      EXPECT_LT(overlap, 1.01 * impact.max_overlap);
    }
    const Real error = std::abs(force_at(impact.loading, overlap) - 1e3 * q[2]);
    if (error > worst) worst = error, worst_at = overlap;
  }
  for (std::size_t n = 0; n < impact.loading.size(); n += 10) {
    const ImpactSample& s = impact.loading[n];
    test::save_result("chung_ooi_1_2",
                      {{"test", number}, {"overlap", s.overlap}, {"force", s.force}});
  }
  expect_absolute("test " + number + " " + material + ", largest error over largest force, at " +
                      std::to_string(1e6 * worst_at) + " um",
                  worst / impact.max_force, 0, 0.02);
}

TEST(ChungOoi, Test1LoadingOfAGlassPair) { expect_loading_branch("1", "glass"); }

TEST(ChungOoi, Test2LoadingOnARigidPlane) { expect_loading_branch("2", "Al alloy"); }

// Closed forms: delta_max = (15 m v^2 / (16 E sqrt R))^(2/5), F_max = (4/3) E sqrt(R)
// delta_max^(3/2), for all materials of both tests.
TEST(ChungOoi, Tests1And2PeakIsThatOfHertz) {
  for (const auto& [test, material] : std::vector<std::pair<std::string, std::string>>{
           {"1", "glass"}, {"1", "limestone"}, {"2", "Al alloy"}, {"2", "Mg alloy"}}) {
    const ImpactCase c = parameters(test, material).impact;
    const ImpactResult impact = run_impact(c, hertz_duration(c) / 1000);
    const Real root = std::sqrt(c.r_eff());
    const Real overlap = std::pow(15 * c.m_eff() * c.v * c.v / (16 * c.e_eff() * root), 0.4);
    const std::string claim = "test " + test + " " + material;
    expect_relative(claim + ", overlap", impact.max_overlap, overlap, 1e-3);
    expect_relative(claim + ", force", impact.max_force,
                    4.0 / 3 * c.e_eff() * root * std::pow(overlap, 1.5), 1e-3);
    expect_relative(claim + ", duration", impact.duration, hertz_duration(c), 1e-3);
    expect_relative(claim + ", restitution", impact.restitution, 1, 1e-3);
  }
}

TEST(ChungOoi, Test3RestitutionIsTheInput) {
  for (const std::string material : {"Al oxide", "cast iron"}) {
    for (const Real e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      ImpactCase c = parameters("3", material).impact;
      c.material.restitution = e;
      const Real measured = run_impact(c, hertz_duration(c) / 5000).restitution;
      test::save_result("chung_ooi_3", {{"material", material}, {"e", e}, {"measured", measured}});
      expect_absolute("test 3 " + material + ", restitution", measured, e, 1e-3);
    }
  }
}

}  // namespace
}  // namespace barchan
