// Limits of steps and ranks for clumps.
#include "src/grains/inertia_in_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/grains/contact_law.hpp"
#include "tests/support/clumps.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using namespace test;

/// Among several ranks a clump may reach over a few columns of the search alone.
TEST(LimitsOfClumps, TooLongForSeveralRanksNamesItsKey) {
  GrainConfig grains;
  grains.kinds.resize(2);
  grains.kinds[1].shape = {.shape = GrainShape::clump, .spheres = rod()};
  LongestArm arm = longest_arm(grains, 1);
  EXPECT_NEAR(arm.length, 3, 1e-9);
  EXPECT_EQ(arm.key, "grains.kind.2.spheres");
  arm.length *= 0.99e-4;
  SearchColumns columns;
  columns.inverse_width_x = columns.inverse_width_z = 1e4;
  EXPECT_EQ(columns_of_arm(arm, columns), 3);
  columns.inverse_width_x = 2e4;
  EXPECT_THROW(columns_of_arm(arm, columns), InputError);
  EXPECT_EQ(message_of([&] { columns_of_arm(arm, columns); }),
            "grains.kind.2.spheres makes clumps with a sphere 0.000297 m from their centre, too "
            "far for several ranks: at most 0.0002 m with spheres this small; take --ranks 1, or "
            "rounder clumps");
}

/// Rods do not shorten the step of the spheres beside them, which turn less easily.
TEST(LimitsOfClumps, StableStepIsThatOfEachKind) {
  Config c = grain_config();
  InitialGrains grains;
  for (const Real x : {2e-3, 2.19e-3, 6e-3}) add_grain(grains, 2e-4, {x, 2e-3, 2e-3});
  const GrainBench spheres(c, grains);
  c.grains->kinds.resize(2);
  c.grains->kinds[0].name = "sphere", c.grains->kinds[1].name = "rod";
  c.grains->kinds[1].shape = {.shape = GrainShape::clump, .spheres = rod()};
  grains.kind = {0, 0, 1};
  const ClumpBench apart(c, grains);
  const Real step = spheres.solver.stable_step(spheres.state);
  ASSERT_TRUE(std::isfinite(step));
  EXPECT_DOUBLE_EQ(apart.solver.stable_step(apart.state), step);
  grains.kind = {1, 0, 0};
  grains.q.assign(3, {1, 0, 0, 0});
  const Real overlap = 1e-6, reach = 1e-4 * width_of(c.grains->kinds[1].shape);
  grains.x[0].x = 2.19e-3 - 1e-4 - reach + overlap;
  const ClumpBench beside(c, grains);
  const Material& m = c.grains->material;
  const Elastic elastic{.youngs_modulus = m.youngs_modulus, .poisson_ratio = m.poisson_ratio};
  const HertzMindlin law =
      HertzMindlin::from({.a = elastic, .b = elastic, .restitution = m.restitution});
  const Real mass = beside.kinematics()(0).m, r = 1e-4 / std::cbrt(Real(4));
  const ContactStiffness k = law(1e-4 * r / (1e-4 + r), mass / 2, overlap);
  const Real slip = inertia_in_contacts(clump_shape(rod()))[0].slip;
  EXPECT_LT(slip, 0.7 * kSlipInertia);
  EXPECT_NEAR(
      beside.solver.stable_step(beside.state) / stable_step(k.k_t, k.gamma_t, slip * mass / 2), 1,
      1e-6);
}

/// By hand for spheres of radius 1 that touch in a row: a force across the row and the normal, at
/// the angle of cosine c from the axis on a sphere at a, has (1 - c^2)/I_1 + (a + c)^2/I_2, largest
/// at c = a / (I_2/I_1 - 1), with I_1 = 2/5 and I_2 = 7/5 for two, 27/5 for four.
TEST(LimitsOfClumps, InertiaInContactsIsThatOfTheWorstPoint) {
  const auto near = [](const InertiaInContacts& found, Real compliance) {
    EXPECT_NEAR(found.spin * compliance, 1.005, 0.005);  // from points: never below the least
    EXPECT_DOUBLE_EQ(found.slip, found.spin / (1 + found.spin));
  };
  const auto two = inertia_in_contacts(clump_shape({{{0, 0, 0}, 1}, {{2, 0, 0}, 1}}));
  ASSERT_EQ(two.size(), 2u);
  for (const InertiaInContacts& sphere : two) near(sphere, 3.5);
  const auto four = inertia_in_contacts(clump_shape(rod()));
  ASSERT_EQ(four.size(), 4u);
  near(four[0], 4.3), near(four[1], 2.7), near(four[2], 2.7), near(four[3], 4.3);
  near(inertia_of({.shape = GrainShape::clump, .spheres = rod()}), 4.3);
  EXPECT_EQ(inertia_of({}).spin, kSpinInertia);
  EXPECT_EQ(inertia_of({}).slip, kSlipInertia);
}

/// The chosen step of a chain is near that of spheres, whose spin is no slower.
TEST(LimitsOfClumps, ChosenStepOfAChainIsNearThatOfSpheres) {
  const auto step = [](const std::string& shape) {
    return case_of("youngs_modulus = 2e4\n" + shape).time.grain_step;
  };
  const Real chain = step(
      "shape = \"clump\"\nspheres = [[0, 0, 0, 1], [2, 0, 0, 1], [4, 0, 0, 1], [6, 0, 0, 1], "
      "[8, 0, 0, 1], [10, 0, 0, 1]]\n");
  EXPECT_LT(chain, step(""));
  EXPECT_GT(chain, step("") / 2);
}

}  // namespace
}  // namespace barchan
