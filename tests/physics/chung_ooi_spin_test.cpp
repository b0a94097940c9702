// Oblique and spinning impacts of Chung & Ooi, Granular Matter 13, 643 (2011): tests 4, 7 and 8.
// Curves and what is known of their accuracy: tests/reference/dem_chung_ooi2011_*.csv.
#include <algorithm>
#include <numbers>

#include "tests/support/grain_bench.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using namespace test;

constexpr Real kDegree = std::numbers::pi / 180;

/// Steps until no surfaces touch any more; the first contact must lie within the first steps.
void run_contact(GrainBench& bench, Real dt) {
  bool touched = false;
  for (int n = 0; n < 1000000; ++n) {
    bench.advance(1, dt);
    const bool touches = norm(bench.contact_force(1)) > 0;
    if (touched && !touches) return;
    touched = touched || touches;
  }
  ADD_FAILURE() << "the surfaces never parted";
}

/// Test 4: a 2.5 mm sphere at 3.9 m/s on a rigid plane, mu = 0.092, e = 0.98.
struct Oblique {
  Real et, omega, patch;  // [-], [rad/s], [degrees]
};

Oblique oblique_impact(const Material& material, Real density, Real theta) {
  const Real r = 2.5e-3, v = 3.9;
  Config config = bench_config(material, density, r);
  config.grains->wall.youngs_modulus = kRigid;
  const Real dt = 2e-9;  // 1/3000 of the contact at normal incidence
  InitialGrains g;
  add_grain(g, 2 * r, {50 * r, r + 1e-12, 50 * r}, {v * std::sin(theta), -v * std::cos(theta), 0});
  GrainBench bench(config, g);
  run_contact(bench, dt);
  const GrainKinematics after = bench.grain(1);
  return {after.u.x / (v * std::sin(theta)), after.omega.z,
          std::atan2(after.u.x + after.omega.z * r, after.u.y) / kDegree};
}

/// Largest deviations over all angles, each over what is allowed.
struct Worst {
  Real law = 0, sliding = 0, paper = 0;
};

void add(Real& worst, const std::string& claim, Real value, Real reference, Real allowed) {
  EXPECT_NEAR(value, reference, allowed) << claim;
  worst = std::max(worst, std::abs(value - reference) / allowed);
}

/// Error of the patch angle [degrees] from errors of the tangential velocity (et) and the spin.
Real patch_error(Real theta, Real et_error, Real spin_error) {
  const Real v_n = 0.98 * 3.9 * std::cos(theta);
  return std::atan((3.9 * std::sin(theta) * et_error + 2.5e-3 * spin_error) / v_n) / kDegree;
}

/// Compares one angle with the columns of one material: `paper` and `law` are the first of its
/// columns.
void compare(const std::string& name, const Oblique& got, const std::vector<Real>& q,
             std::size_t paper, std::size_t law, Worst& worst) {
  const std::string claim = name + " at " + std::to_string(static_cast<int>(q[0])) + " degrees";
  const Real theta = q[0] * kDegree, percent = 0.01;
  test::save_result("chung_ooi_4", {{"material", name},
                                    {"theta_deg", q[0]},
                                    {"et", got.et},
                                    {"omega", got.omega},
                                    {"patch_deg", got.patch}});
  add(worst.law, claim + ", et, law", got.et, q[law], percent * q[law]);
  add(worst.law, claim + ", omega, law", got.omega, q[law + 1], percent * std::abs(q[law + 1]));
  // The patch angle is a difference of the two, which vanishes between 5 and 10 degrees.
  add(worst.law, claim + ", patch, law", got.patch, q[law + 2],
      patch_error(theta, percent * q[law], percent * std::abs(q[law + 1])));
  if (std::isfinite(q[12])) {
    add(worst.sliding, claim + ", et, sliding", got.et, q[12], percent * q[12]);
    add(worst.sliding, claim + ", omega, sliding", got.omega, q[13], percent * std::abs(q[13]));
  }
  // 5 % and the digitising error: 0.005 in et, 2 rad/s, 0.3 degrees.
  const Real et_error = 0.05 * q[paper] + 0.005, spin_error = 0.05 * std::abs(q[paper + 1]) + 2;
  add(worst.paper, claim + ", et, paper", got.et, q[paper], et_error);
  add(worst.paper, claim + ", omega, paper", got.omega, q[paper + 1], spin_error);
  if (paper == 1) {
    add(worst.paper, claim + ", patch, paper", got.patch, q[3],
        patch_error(theta, et_error, spin_error) + 0.3);
  }
}

TEST(ChungOoiSpin, Test4ObliqueImpact) {
  const Material oxide{.youngs_modulus = 3.8e11,
                       .poisson_ratio = 0.23,
                       .restitution = 0.98,
                       .sliding_friction = 0.092};
  Material alloy = oxide;
  alloy.youngs_modulus = 7e10, alloy.poisson_ratio = 0.33;
  Worst worst;
  for (const auto& cells : reference_rows("dem_chung_ooi2011_test4_oblique.csv")) {
    const auto q = numbers(cells);
    const Real theta = q[0] * kDegree;
    compare("Al oxide", oblique_impact(oxide, 4000, theta), q, 1, 6, worst);
    compare("Al alloy", oblique_impact(alloy, 2700, theta), q, 4, 9, worst);
  }
  print_measured("test 4, deviation from the law over 1 %", worst.law, 0, 1);
  print_measured("test 4, deviation from full sliding over 1 %", worst.sliding, 0, 1);
  print_measured("test 4, deviation from the paper over 5 % and digitising", worst.paper, 0, 1);
}

/// Al alloy of tests 6 to 8.
Material al_alloy() {
  return {
      .youngs_modulus = 7e10, .poisson_ratio = 0.33, .restitution = 0.5, .sliding_friction = 0.4};
}

// Two equal spheres meet at 0.2 m/s each with opposite spins: the contact has no slip, so neither
// the spins nor the (vanishing) tangential velocities change.
TEST(ChungOoiSpin, Test7OppositeSpinsStay) {
  const Real r = 0.1;
  for (const Real spin : {2.286, 5.715, 11.43, 22.86}) {
    InitialGrains g;
    add_grain(g, 2 * r, {50 * r, 50 * r, 50 * r}, {0.2, 0, 0}, {0, 0, spin});
    add_grain(g, 2 * r, {52 * r + 1e-9, 50 * r, 50 * r}, {-0.2, 0, 0}, {0, 0, -spin});
    GrainBench bench(bench_config(al_alloy(), 2700, r), g);
    run_contact(bench, 1e-6);
    const GrainKinematics a = bench.grain(1), b = bench.grain(2);
    EXPECT_LT(a.u.x, -0.05) << "they did collide";
    expect_relative("test 7 spin", a.omega.z, spin, 1e-9);
    expect_relative("test 7 spin of the other", b.omega.z, -spin, 1e-9);
    expect_absolute("test 7 tangential velocity", norm(Vec3{0, a.u.y, a.u.z}), 0, 1e-9 * 0.2);
  }
}

enum class Target { same_material, stiff_and_dense, plane };

/// Test 8: a spinning sphere meets one of five times its radius, or a rigid plane. Returns the
/// tangent of the recoil angle of the contact patch, slip over normal speed after the impact.
Real spinning_recoil(Real tan_incident, Target target, CoulombLimit limit) {
  const Real r = 0.1, v = 0.2, large = 5 * r, dt = 5e-7;
  Material material = al_alloy();
  if (target == Target::stiff_and_dense) {
    // 1/E_eff = (1 - s^2)/E (1 + 1/1000), written as a pair of equal moduli.
    material.youngs_modulus *= 2 / (1 + 1e-3);
  }
  Config config = bench_config(material, 2700, r);
  config.grains->wall.youngs_modulus = kRigid;
  config.grains->coulomb_limit = limit;
  const Real y = target == Target::plane ? r : 50 * r;
  InitialGrains g;
  add_grain(g, 2 * r, {50 * r, y + 1e-10, 50 * r}, {0, -v, 0}, {0, 0, tan_incident * v / r});
  if (target != Target::plane) add_grain(g, 2 * large, {50 * r, y - r - large, 50 * r});
  GrainBench bench(config, g);
  if (target == Target::stiff_and_dense) {
    const auto kin = bench.state.kin;
    Kokkos::parallel_for(
        "test: dense sphere", 2, KOKKOS_LAMBDA(int p) {
          if (kin(p).r > 2 * r) kin(p).m *= 1000;
        });
  }
  run_contact(bench, dt);
  GrainKinematics small = bench.grain(1), other;
  if (target != Target::plane) other = bench.grain(2);
  const Real slip = small.u.x + r * small.omega.z -
                    (other.u.x - (target == Target::plane ? 0 : large) * other.omega.z);
  return slip / (small.u.y - other.u.y);
}

/// Calls check(claim, incident, recoil, digitised) for every row and target.
template <class Check>
void for_spinning_impacts(CoulombLimit limit, Check check) {
  const std::vector<std::pair<std::string, Target>> targets{{"case A", Target::same_material},
                                                            {"case B", Target::stiff_and_dense},
                                                            {"plane", Target::plane}};
  for (const auto& cells : reference_rows("dem_chung_ooi2011_test7_8.csv")) {
    const auto q = numbers(cells);
    for (std::size_t t = 0; t < 3; ++t) {
      const Real recoil = spinning_recoil(q[0], targets[t].second, limit);
      const std::string part = limit == CoulombLimit::total ? "total" : "elastic";
      test::save_result(
          "chung_ooi_8",
          {{"limit", part}, {"target", targets[t].first}, {"tan_inc", q[0]}, {"tan_rec", recoil}});
      check("test 8 " + targets[t].first + " at " + cells[0], q[0], recoil, q[1 + t]);
    }
  }
}

// Full sliding: the impulse of friction is mu times that of |F_n|. With the attractive tail of the
// damped law the latter is m v (1 + 2 e_clip - e), e_clip the restitution with the tail cut off
// (dem_restitution_of_damped_hertz_law.csv): tan = (x - (7/2) mu (1 + 2 e_clip - e))/e.
TEST(ChungOoiSpin, Test8SlidingEndsOfTheDampedLaw) {
  const Real e = 0.5, e_clip = 0.5503, mu = 0.4;
  for_spinning_impacts(
      CoulombLimit::total, [&](const std::string& claim, Real x, Real recoil, Real) {
        if (x > 3) expect_relative(claim, recoil, (x - 3.5 * mu * (1 + 2 * e_clip - e)) / e, 0.01);
      });
}

// The curves of the paper, and (x - (7/2) mu (1 + e))/e = (x - 2.1)/0.5 in full sliding: friction
// is limited by the elastic part of the normal force, whose impulse is m v (1 + e) like that of the
// total. A sphere a thousand times stiffer and denser (case B) is a plane: the law knows the moduli
// only through k_t/k_n. The digitised curve of case B lies up to 0.15 above that of the plane. At
// two angles it is missed by that (0.120 and 0.134 for 0.1; docs/validation.md says so): there the
// motion is compared with the plane's.
TEST(ChungOoiSpin, Test8SpinningImpact) {
  for_spinning_impacts(CoulombLimit::elastic, [](const std::string& claim, Real x, Real recoil,
                                                 Real digitised) {
    const bool sliding = x > 3, missed = claim.find("case B") != claim.npos && x > 1.1 && x < 1.5;
    if (sliding) {
      expect_relative(claim + ", sliding", recoil, (x - 2.1) / 0.5, 0.01);
    } else if (!missed) {
      expect_absolute(claim, recoil, digitised, 0.1);
    } else {
      print_measured(claim + ", missed", recoil, digitised, 0.1);
      expect_absolute(claim + ", of the plane", recoil,
                      spinning_recoil(x, Target::plane, CoulombLimit::elastic), 1e-3);
    }
  });
}

}  // namespace
}  // namespace barchan
