// What a grain finds of the flow around it: velocity, forces of pressure gradient and stress.
#include <gtest/gtest.h>

#include "tests/support/coupled_run.hpp"

namespace barchan {
namespace {

constexpr double kCell = 1e-3;  // [m]

/// A grain held in a box of 4 x 6 x 4 cells; velocity or pressure are then set by hand.
test::CoupledRun held_grain(const Vec3& x) {
  Config config = test::water_box({4, 6, 4}, {4 * kCell, 6 * kCell, 4 * kCell});
  config.grains->frozen = true;
  InitialGrains grain;
  test::add_grain(grain, 2e-4, x);
  return {config, grain};
}

template <class Value>
void set(const Field& field, const test::CoupledRun& run, const Value& value) {
  test::set_everywhere(field, test::HostGrid(run.state.fluid->grid).ref(), value);
}

/// Pressure force in the next step, per volume [N/m^3].
Vec3 pressure_force(test::CoupledRun& run) {
  run.advance();
  return (1 / sphere_volume(1e-4)) * test::force_on_first(run, "force_pressure_gradient");
}

// Between the floor and the first face above it the pressure force is that of this face.
TEST(FlowAtGrains, PressureForceAtTheFloorIsThatOfTheFirstFace) {
  test::CoupledRun run = held_grain({1.7e-3, 3e-4, 2.2e-3});
  set(run.state.fluid->p, run, [](int, int j, int) { return 5.0 * j * j; });
  EXPECT_NEAR(pressure_force(run).y / (-5.0 / kCell), 1, 1e-12);  // from row 0 to row 1
}

// p = 5 (i^2 + 2 j^2 + 3 k^2) Pa: the force in a cell is the mean of its faces.
TEST(FlowAtGrains, ForceInACellIsTheMeanOfItsFaces) {
  test::CoupledRun run = held_grain({1.5 * kCell, 2.5 * kCell, 2.5 * kCell});
  set(run.state.fluid->p, run,
      [](int i, int j, int k) { return 5.0 * (i * i + 2 * j * j + 3 * k * k); });
  const Vec3 force = pressure_force(run);
  EXPECT_NEAR(force.x / (-10.0 * 1 / kCell), 1, 1e-12);
  EXPECT_NEAR(force.y / (-20.0 * 2 / kCell), 1, 1e-12);
  EXPECT_NEAR(force.z / (-30.0 * 2 / kCell), 1, 1e-12);
}

TEST(FlowAtGrains, ByRowVerticalVelocityIsThatAtTheCentre) {
  test::CoupledRun run = held_grain({1.7e-3, 2.3e-3, 2.2e-3});
  set(run.state.fluid->u.y, run, [](int, int j, int) { return 3.0 * j * kCell; });
  run.advance();
  EXPECT_NEAR(test::host_copy(run.state.grains->fluid.u_f)(0).y / (3.0 * 2.3e-3), 1, 1e-12);
}

}  // namespace
}  // namespace barchan
