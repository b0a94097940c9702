// Derived numbers against the values known for the paper's case.
#include "src/case/derived.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace barchan {
namespace {

/// The paper's dune on mesh 1.
Config paper_case() {
  Config c;
  c.time.end = 100;
  c.size = {0.4, 0.025, 0.1};
  c.fluid =
      FluidConfig{.cells = {250, 30, 63}, .first_cell_height = 2.625e-4, .mean_velocity = 0.28};
  c.grains = GrainConfig{};
  return c;
}

const std::vector<SizeClass> table_2{
    {0.15e-3, 2276}, {0.175e-3, 13592}, {0.2e-3, 68267}, {0.225e-3, 13591}, {0.25e-3, 2274}};

TEST(Derived, RayleighTimesOfThePapersGrains) {
  EXPECT_NEAR(rayleigh_time(0.15e-3, 2500, Material{}), 9.444388e-6, 1e-12);
  EXPECT_NEAR(rayleigh_time(0.2e-3, 2500, Material{}), 1.259252e-5, 1e-11);
}

/// Force of Hertz between two spheres of the paper [N] at an overlap over the diameter.
double hertz_force(double overlap, double d, const Material& m) {
  const double modulus = m.youngs_modulus / (2 * (1 - m.poisson_ratio * m.poisson_ratio));
  return 4.0 / 3 * modulus * std::sqrt(d / 4) * std::pow(overlap * d, 1.5);
}

TEST(Derived, OverlapAtRestCarriesTheLayersAbove) {
  const double d = 0.2e-3, weight = 1500 * 9.81;
  const double of_15 = 15 * weight * std::numbers::pi / 6 * d * d * d;
  const double overlap = overlap_at_rest(15, d, weight, Material{});
  EXPECT_NEAR(hertz_force(overlap, d, Material{}), of_15, 1e-12 * of_15);
  EXPECT_NEAR(overlap, 5.0e-4, 0.2e-4);
}

/// Integrates the motion of two grains that meet, up to their largest overlap.
TEST(Derived, OverlapOfAnImpactIsThatOfTheEquationOfMotion) {
  const double d = 0.2e-3, speed = 0.112, mass = 2500 * std::numbers::pi / 6 * d * d * d / 2;
  const Material soft{.youngs_modulus = 3.125e5};
  const double dt = 1e-9;
  double overlap = 0;  // [m]
  for (double v = speed; v > 0; overlap += v * dt)
    v -= hertz_force(overlap / d, d, soft) / mass * dt;
  EXPECT_NEAR(overlap_of_impact(2500, speed, soft), overlap / d, 1e-4 * overlap / d);
}

TEST(Derived, FallVelocitiesOfThePapersGrains) {
  EXPECT_NEAR(settling_velocity(0.15e-3, 2.5, 1e-6, 9.81), 0.01462872, 1e-8);
  EXPECT_NEAR(settling_velocity(0.2e-3, 2.5, 1e-6, 9.81), 0.02291683, 1e-8);
  EXPECT_NEAR(settling_velocity(0.25e-3, 2.5, 1e-6, 9.81), 0.03154384, 1e-8);
}

TEST(Derived, FrictionVelocity) {
  // MKM chan395: u*/U = 1/17.545 at Re 13765 ; Dean's fit is good to a few per cent.
  EXPECT_NEAR(friction_velocity(17.545, 1.0, 1 / 392.24), 1.0, 0.03);
  // Laminar: u*^2 = 3 nu U / delta.
  EXPECT_NEAR(friction_velocity(1e-3, 0.01, 1e-6), std::sqrt(3 * 1e-6 * 1e-3 / 0.01), 1e-12);
  EXPECT_EQ(friction_velocity(0.0, 0.025, 1e-6), 0.0);
  for (const double speed : {1e-3, 0.03, 0.28, 5.0}) {
    EXPECT_NEAR(bulk_velocity_of(friction_velocity(speed, 0.025, 1e-6), 0.025, 1e-6), speed,
                1e-12 * speed);
  }
}

TEST(Derived, StepsAreWholeAndForgiveRoundOff) {
  EXPECT_EQ(grain_substeps({.end = 1, .fluid_step = 2.5e-4, .grain_step = 2.5e-6}), 100);
  // 2.5e-4 / 1e-6 is 250.00000000000003 in floating point.
  EXPECT_EQ(grain_substeps({.end = 1, .fluid_step = 2.5e-4, .grain_step = 1e-6}), 250);
  EXPECT_EQ(grain_substeps({.end = 1, .fluid_step = 2.5e-4, .grain_step = 2.4e-6}), 105);
  EXPECT_EQ(grain_substeps({.end = 1, .fluid_step = 1e-6, .grain_step = 2.5e-6}), 1);
  EXPECT_EQ(grain_substeps({.end = 1, .fluid_step = 1, .grain_step = 1e-300}), 2000000000);
  EXPECT_NEAR(true_grain_step({.end = 1, .fluid_step = 2.5e-4, .grain_step = 2.4e-6}), 2.5e-4 / 105,
              1e-18);
  EXPECT_EQ(fluid_steps({.end = 0.3, .fluid_step = 1e-4, .grain_step = 1e-4}), 3000);
  EXPECT_EQ(fluid_steps({.end = 100, .fluid_step = 2.5e-4, .grain_step = 1e-4}), 400000);
  EXPECT_EQ(fluid_steps({.end = 1.00001, .fluid_step = 1e-4, .grain_step = 1e-4}), 10001);
}

TEST(Derived, FlowOfThePapersCase) {
  const FluidNumbers n = *derive(paper_case(), table_2).fluid;
  EXPECT_EQ(n.cells, 472500);
  EXPECT_NEAR(n.reynolds, 14000, 1e-6);
  EXPECT_NEAR(n.u_star, 0.016, 0.0005);
  EXPECT_NEAR(n.y1_plus, 2.1, 0.07);
  EXPECT_NEAR(n.stretching, 1.0705, 5e-5);
  EXPECT_NEAR(n.dy_last / n.dy_first, 7.20, 0.01);
  EXPECT_NEAR(n.cfl, 0.0503, 1e-4);
  EXPECT_NEAR(n.pressure_gradient, 1000 * n.u_star * n.u_star / 0.025, 1e-9);
}

TEST(Derived, GrainsOfThePapersCase) {
  const GrainNumbers n = *derive(paper_case(), table_2).grains;
  EXPECT_EQ(n.count, 100000);
  EXPECT_NEAR(n.d_mean, 1.9999875e-4, 1e-12);
  EXPECT_NEAR(n.solid_volume, 4.278e-7, 1e-10);
  EXPECT_NEAR(n.fraction_min, 0.2647075, 1e-6);
  EXPECT_NEAR(n.fraction_mean, 0.1985306, 1e-5);
  EXPECT_NEAR(n.easiest.shields_threshold, 0.0487, 1e-4);
  EXPECT_NEAR(n.easiest.shields, 0.0870, 0.003);  // 0.0870 for u* = 0.016
  EXPECT_NEAR(n.cell_ratio, 1.3125, 1e-4);
  EXPECT_NEAR(n.floor_ratio, 1.3125, 1e-4);
  EXPECT_EQ(n.top, 0);
}

TEST(Derived, RowAtTheTopOfTheGrains) {
  // Rows of 0.2625 mm grow by 1.0705: the one from 3.2 to 3.7 mm is the tenth, 0.485 mm.
  const GrainNumbers n = *derive(paper_case(), table_2, 3.5e-3).grains;
  EXPECT_NEAR(n.top_ratio, 2.625e-4 * std::pow(1.0705, 9) / 1.9999875e-4, 0.01);
  EXPECT_EQ(derive(paper_case(), table_2, 1.0).grains->top, 0);  // above the lid
}

TEST(Derived, PressureGradientGivesItsFrictionVelocityExactly) {
  Config c = paper_case();
  c.fluid->mean_velocity = 0;
  c.fluid->pressure_gradient = 10.24;
  const FluidNumbers n = *derive(c, {}).fluid;
  EXPECT_NEAR(n.u_star, 0.016, 1e-12);
  EXPECT_NEAR(n.bulk_velocity, 0.28, 0.006);
}

TEST(Derived, ASecondWallHalvesTheDepthAndNoWallHasNoFriction) {
  Config c = paper_case();
  c.fluid->top = WallFlow::no_slip;
  EXPECT_NEAR(derive(c, {}).fluid->reynolds, 7000, 1e-6);
  c.fluid->top = c.fluid->bottom = WallFlow::free_slip;
  EXPECT_EQ(derive(c, {}).fluid->u_star, 0.0);
}

}  // namespace
}  // namespace barchan
