// Normal impacts through list, contact law and integrator: against Hertz and the restitution, and
// against Chung & Ooi, Granular Matter 13, 643 (2011). Materials and curves are in
// tests/reference/dem_*.csv. Spinning and oblique impacts: chung_ooi_spin_test.cpp.
#include <algorithm>

#include "kernels/grains/sphere.hpp"
#include "tests/support/grain_bench.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using namespace test;

// --- Central impacts through the solver: a pair head-on, or a grain on a wall.

struct ImpactCase {
  Material material;
  Real wall_modulus = 0;  // [Pa]; used with on_wall
  Real density = 2500, radius = 1e-4;
  Real v = 0;  // speed of approach [m/s]
  bool on_wall = false;

  Real e_eff() const {
    const Elastic grain{.youngs_modulus = material.youngs_modulus,
                        .poisson_ratio = material.poisson_ratio};
    Elastic other = grain;
    if (on_wall) other.youngs_modulus = wall_modulus;
    return effective_youngs_modulus(grain, other);
  }
  /// Grains that move, each as it would against a wall at this height [m].
  int sides() const { return on_wall ? 1 : 2; }
  Real plane() const { return on_wall ? 0 : 50 * radius; }
  Real r_eff() const { return radius / sides(); }
  Real m_eff() const { return sphere_volume(radius) * density / sides(); }
};

/// Overlap and force in one step of a contact.
struct ImpactSample {
  Real overlap = 0, force = 0;  // [m], [N]
};

struct ImpactResult {
  Real max_overlap = 0, max_force = 0;  // largest of the steps' ends [m], [N]
  Real duration = 0, restitution = 0;   // [s], [-]
  std::vector<ImpactSample> loading;    // until the largest overlap
};

/// The surfaces are `gap` apart [m].
GrainBench before_impact(const ImpactCase& c, Real gap) {
  Config config = bench_config(c.material, c.density, c.radius);
  if (c.on_wall) config.grains->wall.youngs_modulus = c.wall_modulus;
  const Real r = c.radius, height = r + gap / c.sides(), v = c.v / c.sides();
  InitialGrains g;
  add_grain(g, 2 * r, {50 * r, c.plane() + height, 50 * r}, {0, -v, 0});
  if (!c.on_wall) add_grain(g, 2 * r, {50 * r, c.plane() - height, 50 * r}, {0, v, 0});
  return GrainBench(config, g);
}

/// Runs one impact at a constant step; the surfaces meet after (1 + phase) steps of free flight.
ImpactResult run_impact(const ImpactCase& c, Real dt, Real phase = 0.5) {
  GrainBench bench = before_impact(c, (1 + phase) * dt * c.v);
  const auto gap_of = [&c](const GrainKinematics& g) {  // of the surfaces
    return c.sides() * (g.x.y - c.plane() - g.r);
  };
  const Real touch = gap_of(bench.grain(1)) / c.v;  // free flight is exact
  ImpactResult result;
  bool touched = false;
  for (int n = 1; n < 2000000; ++n) {
    bench.advance(1, dt);
    const GrainKinematics grain = bench.grain(1);
    const Real gap = gap_of(grain), speed = c.sides() * grain.u.y;
    if (gap < 0) {
      touched = true;
      const ImpactSample sample{-gap, bench.contact_force(1).y};
      if (sample.overlap > result.max_overlap) result.loading.push_back(sample);
      result.max_overlap = std::max(result.max_overlap, sample.overlap);
      result.max_force = std::max(result.max_force, sample.force);
    } else if (touched) {
      result.restitution = speed / c.v;
      result.duration = n * dt - gap / speed - touch;
      return result;
    }
  }
  ADD_FAILURE() << "the surfaces never parted";
  return result;
}

// --- The grain of Table II and others, against closed forms.

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

// --- Chung & Ooi, tests 1 to 3.

/// The row of a test for a material; ranges (test 3) are given by their lower end.
ImpactCase parameters(const std::string& test, const std::string& material) {
  for (const auto& cells : reference_rows("dem_chung_ooi2011_parameters.csv")) {
    if (cells[0] != test || cells[2] != material) continue;
    const auto q = numbers(cells, 3);
    const bool rigid = q[7] == 1;
    return {.material = {.youngs_modulus = q[0],
                         .poisson_ratio = q[1],
                         .restitution = q[3],
                         .sliding_friction = q[2]},
            .wall_modulus = kRigid,
            .density = q[4],
            .radius = q[5],
            .v = rigid ? q[6] : 2 * q[6],
            .on_wall = rigid};
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
  const ImpactCase c = parameters(number, material);
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
    const ImpactCase c = parameters(test, material);
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
      ImpactCase c = parameters("3", material);
      c.material.restitution = e;
      const Real measured = run_impact(c, hertz_duration(c) / 5000).restitution;
      test::save_result("chung_ooi_3", {{"material", material}, {"e", e}, {"measured", measured}});
      expect_absolute("test 3 " + material + ", restitution", measured, e, 1e-3);
    }
  }
}

}  // namespace
}  // namespace barchan
