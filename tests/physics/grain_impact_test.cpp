// Normal impacts through list, contact law and integrator, against Hertz and the restitution.
#include "tests/support/grain_impact.hpp"

namespace barchan {
namespace {

using namespace testing;

/// A row of dem_hertz_normal_impact.csv.
struct HertzRow {
  std::string name;
  Real v, e_eff, r_eff, m_eff, max_overlap, max_force, duration;
};

std::vector<HertzRow> hertz_rows() {
  std::vector<HertzRow> rows;
  for (const auto& cells : reference_rows("dem_hertz_normal_impact.csv")) {
    const auto q = numbers(cells, 1);
    rows.push_back({cells[0], q[0], q[1], q[2], q[3], q[4], q[5], q[6]});
  }
  return rows;
}

/// The grain of Table II that meets its like or a wall of its own material.
ImpactCase seed_case(Real v, bool on_wall, Real restitution) {
  ImpactCase c{.material = {.restitution = restitution}, .v = v, .on_wall = on_wall};
  c.wall_modulus = c.material.youngs_modulus;
  return c;
}

/// Radius, density and moduli such that E_eff, R_eff and m_eff are those of the row.
ImpactCase case_of(const HertzRow& row) {
  const bool on_wall =
      row.name.find("pair") == std::string::npos || row.name.find("on wall") != std::string::npos;
  if (row.name.starts_with("seed")) return seed_case(row.v, on_wall, 1);
  const Real nu = 0.25;
  ImpactCase c{.material = {.poisson_ratio = nu, .restitution = 1},
               .wall_modulus = kRigid,
               .radius = on_wall ? row.r_eff : 2 * row.r_eff,
               .v = row.v,
               .on_wall = on_wall};
  c.material.youngs_modulus = row.e_eff * (1 - nu * nu) * (on_wall ? 1 : 2);
  c.density = row.m_eff * (on_wall ? 1 : 2) / sphere_volume(c.radius);
  return c;
}

void expect_hertz(const HertzRow& row, const ImpactResult& impact, Real tolerance) {
  expect_relative(row.name + ", overlap", impact.max_overlap, row.max_overlap, tolerance);
  expect_relative(row.name + ", force", impact.max_force, row.max_force, tolerance);
  expect_relative(row.name + ", duration", impact.duration, row.duration, tolerance);
}

TEST(NormalImpact, FollowsHertzAtAFineStep) {
  for (const HertzRow& row : hertz_rows()) {
    const ImpactCase c = case_of(row);
    EXPECT_NEAR(c.e_eff() / row.e_eff, 1, 1e-6) << row.name;
    EXPECT_NEAR(c.m_eff() / row.m_eff, 1, 1e-6) << row.name;
    EXPECT_NEAR(c.r_eff() / row.r_eff, 1, 1e-12) << row.name;
    expect_hertz(row, run_impact(c, row.duration / 250), 1e-3);
  }
}

TEST(NormalImpact, FollowsHertzAtThePapersStep) {
  for (const HertzRow& row : hertz_rows()) {
    if (!row.name.starts_with("seed")) continue;
    for (const Real phase : {0.1, 0.3, 0.5, 0.7, 0.9}) {  // where in a step the surfaces meet
      expect_hertz(row, run_impact(case_of(row), 2.5e-6, phase), 1e-2);
    }
  }
}

TEST(Restitution, IsThatOfTheDampedLawAtAFineStep) {
  for (const auto& cells : reference_rows("dem_restitution_of_damped_hertz_law.csv")) {
    const auto q = numbers(cells);
    for (const bool on_wall : {false, true}) {
      for (const Real v : {0.05, 0.2}) {  // independent of the speed (Antypov & Elliott 2011)
        const Real e = run_impact(seed_case(v, on_wall, q[0]), 2e-8).restitution;
        expect_absolute("restitution " + cells[0] + (on_wall ? " on wall" : " of pair"), e, q[1],
                        1e-3);
      }
    }
  }
}

// The table's impact starts at the first touch: a step begins with an overlap of zero. Where in a
// step the surfaces meet changes the restitution; that scatter is printed.
TEST(Restitution, IsThatOfTheDampedLawAtThePapersStep) {
  for (const auto& cells : reference_rows("dem_restitution_of_damped_hertz_law.csv")) {
    const auto q = numbers(cells);
    for (const bool on_wall : {false, true}) {
      const ImpactCase c = seed_case(0.05, on_wall, q[0]);
      const std::string claim = "restitution " + cells[0] + (on_wall ? " on wall" : " of pair");
      const Real e = run_impact(c, 2.5e-6, 0).restitution;
      // The column of this step where the table has a value, which is for the pair.
      const bool stepped = !on_wall && std::isfinite(q[3]);
      expect_absolute(claim, e, stepped ? q[3] : q[1], 1e-2);
      Real lowest = e, highest = e;
      for (const Real phase : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const Real other = run_impact(c, 2.5e-6, phase).restitution;
        lowest = std::min(lowest, other), highest = std::max(highest, other);
      }
      std::printf("[ measured ] %s, any phase: %.4f to %.4f\n", claim.c_str(), lowest, highest);
    }
  }
}

}  // namespace
}  // namespace barchan
