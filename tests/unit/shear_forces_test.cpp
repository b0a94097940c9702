// Lift, torque and the floor's part of the drag against the numbers of their sources.
#include <gtest/gtest.h>

#include "kernels/coupling/shear_forces.hpp"

namespace barchan {
namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr Real kD = 2e-4;  // [m]

/// Water at a Reynolds number slip d/nu in a shear over a floor at which the velocity at the
/// grain's centre is the slip: vorticity = slip/(gap + d/2).
LocalShear linear_shear(Real reynolds, Real delta) {
  const Real slip = reynolds * 1e-6 / kD;
  return {.rho_f = 1000,
          .mu_f = 1e-3,
          .d_p = kD,
          .slip = slip,
          .vorticity = slip / ((delta + 0.5) * kD),
          .gap = delta * kD};
}

// Saffman (1965, 1968): 6.46 mu a^2 slip sqrt(w/nu).
TEST(Lift, IsSaffmansInCreepingFlow) {
  LocalShear s{.rho_f = 1000, .mu_f = 1e-3, .d_p = kD, .slip = 1e-9, .vorticity = 1e-7, .gap = 1};
  const Real saffman = 6.46 * 1e-3 * kD * kD / 4 * std::sqrt(s.vorticity / 1e-6);
  EXPECT_NEAR(lift_coefficient(s) / saffman, 1, 1e-4);
  s.vorticity *= 4;
  EXPECT_NEAR(lift_coefficient(s) / saffman, 2, 1e-4);
}

// Mei (1992): the branches are chosen to meet at Re = 40 but for (1 - 0.3314 sqrt(b)) exp(-4).
TEST(Lift, BranchesOfMeiMeet) {
  for (const Real b : {0.005, 0.1, 0.4}) {
    const Real below = saffman_mei_factor(40, b), above = saffman_mei_factor(40.000001, b);
    EXPECT_NEAR(below - above, (1 - 0.3314 * std::sqrt(b)) * std::exp(-4.0), 1e-4);
    EXPECT_LT(saffman_mei_factor(10, b), 1);
  }
  // b = w d/(2 slip): 0.1 at Re = 10.
  const LocalShear inside{
      .rho_f = 1000, .mu_f = 1e-3, .d_p = kD, .slip = 0.05, .vorticity = 50, .gap = 1};
  EXPECT_NEAR(saffman_mei(inside) / (1.615 * kD * kD * std::sqrt(50.0)),
              saffman_mei_factor(10, 0.1), 1e-9);
  // The factor stays that at the end of the range of b beyond it: no slip, no lift, and nothing
  // infinite.
  LocalShear s = linear_shear(1e-3, 10);
  s.vorticity = 1000;
  EXPECT_NEAR(saffman_mei(s) / (1.615 * kD * kD * std::sqrt(1000.0)), saffman_mei_factor(1e-3, 0.4),
              1e-9);
  s.slip = 0;
  EXPECT_TRUE(std::isfinite(lift_coefficient(s)));
  s.vorticity = 0;
  EXPECT_EQ(lift_coefficient(s), 0);
}

// Leighton & Acrivos (1985): 9.22 rho G^2 a^4 on a sphere that touches the floor, Re -> 0.
TEST(Lift, IsLeightonAndAcrivosAtTheFloor) {
  const LocalShear s = linear_shear(1e-3, 0);
  const Real a = kD / 2, force = lift_coefficient(s) * s.slip;
  EXPECT_NEAR(force / (9.22 * 1000 * s.vorticity * s.vorticity * std::pow(a, 4)), 1, 2e-3);
}

// Zeng et al. (2009), table I: their spectral results at a gap of 0.005 d.
TEST(Lift, IsThatOfZengNearTheFloor) {
  EXPECT_NEAR(floor_lift_coefficient(2, 0.005) / 2.653, 1, 0.02);
  EXPECT_NEAR(floor_lift_coefficient(10, 0.005) / 1.305, 1, 0.02);
  EXPECT_NEAR(floor_lift_coefficient(200, 0.005) / 0.3384, 1, 0.05);
  EXPECT_EQ(floor_lift_coefficient(300, 0.1), floor_lift_coefficient(200, 0.1));
  // Table VI: at a gap of d/4 lift changes its sign at Re = 198.
  EXPECT_GT(floor_lift_coefficient(190, 0.25), 0);
  EXPECT_LT(floor_lift_coefficient(199, 0.25), 0);
}

TEST(Lift, GoesOverFromTheFloorToTheBulk) {
  const auto floor = [](const LocalShear& s, Real delta) {
    return floor_lift_coefficient(1000 * s.slip * kD / 1e-3, delta) * kPi / 8 * 1000 * kD * kD *
           s.slip;
  };
  const LocalShear low = linear_shear(5, 0.5), high = linear_shear(5, 1),
                   middle = linear_shear(5, 0.75);
  EXPECT_NEAR(lift_coefficient(low) / floor(low, 0.5), 1, 1e-12);
  EXPECT_NEAR(lift_coefficient(high) / saffman_mei(high), 1, 1e-12);
  EXPECT_NEAR(lift_coefficient(middle) / ((floor(middle, 0.75) + saffman_mei(middle)) / 2), 1,
              1e-12);
  // The two sources agree where they meet: in the shear of a sand grain within a third.
  EXPECT_NEAR(floor(middle, 0.75) / saffman_mei(middle), 1, 0.33);
}

// Goldman, Cox & Brenner (1967), part II, table 1: force on a sphere held in creeping shear over
// that of Stokes, at the height h/a of its centre.
TEST(WallDrag, IsGoldmansInCreepingShear) {
  const Real table[][2] = {{10.0677, 1.0587},  {3.7622, 1.1671}, {2.3524, 1.2780},
                           {1.5431, 1.4391},   {1.1276, 1.6160}, {1.0453, 1.6682},
                           {1.005004, 1.6969}, {1, 1.7005}};
  for (const auto& [height, factor] : table) {
    EXPECT_NEAR(floor_drag_factor(0, (height - 1) / 2) / factor, 1, 0.01) << height;
  }
  // O'Neill (1968) for the sphere that touches; Faxen far away.
  EXPECT_NEAR(floor_drag_factor(0, 0), 1.7009, 1e-3);
  EXPECT_NEAR((floor_drag_factor(0, 50) - 1) * 101, 9.0 / 16, 1e-3);
}

TEST(WallDrag, FadesWithHeightAtAnyReynoldsNumber) {
  for (const Real reynolds : {0.1, 5.0, 50.0, 200.0}) {
    EXPECT_GT(floor_drag_factor(reynolds, 0), 1.5);
    EXPECT_GT(floor_drag_factor(reynolds, 0), floor_drag_factor(reynolds, 0.5));
    EXPECT_NEAR(floor_drag_factor(reynolds, 1000), 1, 1e-3);
  }
  EXPECT_EQ(floor_drag_factor(300, 0.1), floor_drag_factor(200, 0.1));
}

TEST(RotationalDrag, IsKirchhoffsInCreepingFlow) {
  const Real creeping = 8 * kPi * 1e-3 * std::pow(kD / 2, 3);
  EXPECT_NEAR(rotational_drag(1000, 1e-3, kD, 0) / creeping, 1, 1e-12);
  EXPECT_NEAR(rotational_drag(1000, 1e-3, kD, 30e-6 / (kD * kD)) / creeping, 1, 1e-12);
}

// T = C_r (rho/2) (d/2)^5 spin^2, C_r = 12.9/sqrt(Re_r) + 128.4/Re_r.
TEST(RotationalDrag, IsThatOfDennisWhenFast) {
  for (const Real reynolds : {50.0, 200.0, 1000.0}) {
    const Real spin = reynolds * 1e-6 / (kD * kD);
    const Real c_r = 12.9 / std::sqrt(reynolds) + 128.4 / reynolds;
    EXPECT_NEAR(rotational_drag(1000, 1e-3, kD, spin) * spin /
                    (c_r * 500 * std::pow(kD / 2, 5) * spin * spin),
                1, 1e-12);
  }
  // The two meet near Re_r = 32.
  EXPECT_NEAR(12.9 / std::sqrt(32.0) + 128.4 / 32, 64 * kPi / 32, 0.02);
}

}  // namespace
}  // namespace barchan
