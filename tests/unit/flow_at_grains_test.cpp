// Flow at a grain: velocity, forces of pressure gradient and stress.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/grains/sphere.hpp"
#include "src/fluid/poisson_fft.hpp"
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

// The pressure force between the floor and the first face above it is that of this face.
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

// Any pressure, smoothed: each component of the force in cells, the mean of its faces, is smoothed.
TEST(FlowAtGrains, PressureForceIsThatOfTheCellsSmoothed) {
  Config config = test::water_box({8, 6, 5}, {8 * kCell, 6 * kCell, 5 * kCell});
  config.grains->frozen = true;
  config.coupling.smoothing_length = 1.3 * kCell;
  InitialGrains grain;
  test::add_grain(grain, 2e-4, {1.5 * kCell, 0.5 * kCell, 4.5 * kCell});
  test::CoupledRun run(config, grain);
  FluidState& fluid = *run.state.fluid;
  const Grid& grid = fluid.grid;
  test::set_random(fluid.p, grid, 11);
  run.fill_ghosts();
  const test::HostField p = test::to_host(fluid.p);
  const PoissonFft smoother(grid, std::make_shared<const PlaneFft>(grid), 1,
                            std::pow(config.coupling.smoothing_length, 2));
  const auto smoothed = [&](auto mean_of_faces) {
    Field f("test: force", grid);
    test::set_field(f, grid, mean_of_faces);
    smoother.solve(f, f);
    return test::to_host(f)(1, 0, 4);
  };
  const auto at_face_y = [&](int i, int j, int k) {  // those on the walls are as the next ones
    const int inside = std::clamp(j, 1, 5);
    return -(p(i, inside, k) - p(i, inside - 1, k)) / kCell;
  };
  const Vec3 expected{
      smoothed([&](int i, int j, int k) { return -(p(i + 1, j, k) - p(i - 1, j, k)) / 2 / kCell; }),
      smoothed(
          [&](int i, int j, int k) { return (at_face_y(i, j, k) + at_face_y(i, j + 1, k)) / 2; }),
      smoothed(
          [&](int i, int j, int k) { return -(p(i, j, k + 1) - p(i, j, k - 1)) / 2 / kCell; })};
  const Vec3 force = pressure_force(run);
  EXPECT_NEAR(norm(force - expected) / norm(expected), 0, 1e-12);
}

TEST(FlowAtGrains, ByRowVerticalVelocityIsThatAtTheCentre) {
  test::CoupledRun run = held_grain({1.7e-3, 2.3e-3, 2.2e-3});
  set(run.state.fluid->u.y, run, [](int, int j, int) { return 3.0 * j * kCell; });
  run.advance();
  EXPECT_NEAR(host_copy(run.state.grains->fluid.u_f)(0).y / (3.0 * 2.3e-3), 1, 1e-12);
}

}  // namespace
}  // namespace barchan
