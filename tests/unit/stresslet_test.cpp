// Viscosity that a grain moving with its fluid adds to the rows that it lies in.
#include "kernels/coupling/stresslet.hpp"

#include <gtest/gtest.h>

#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

constexpr Real kRadius = 1e-4, kMu = 1e-3;  // [m], [Pa s]

/// Rows of the same height [m].
test::HostGrid even_rows(Real height) {
  return test::HostGrid{make_grid(7, 5, 0.0112, 0.008, row_faces({40 * height, 40, 0}))};
}

GrainKinematics grain_at(Real y, const Vec3& u) {
  return {.x = {0.004, y, 0.003}, .r = kRadius, .u = u, .m = 1, .omega = {}};
}

// Boyer, Guazzelli & Pouliquen (2011), by hand; Einstein (1906) at phi = 0.
TEST(Stresslet, ViscosityIsThatOfSuspensions) {
  EXPECT_EQ(viscosity_of_grains(0), 2.5);
  EXPECT_NEAR(0.3 * viscosity_of_grains(0.3), 1.5395, 1e-4);
  EXPECT_NEAR(0.5 * viscosity_of_grains(0.5), 8.6029, 1e-4);
  EXPECT_NEAR(0.565 * viscosity_of_grains(0.565), 41.316, 1e-3);
  EXPECT_EQ(viscosity_of_grains(0.62), viscosity_of_grains(0.565));
}

// Rows from a third to two thirds of a grain: at every height the moment of the forces is
// mu V_p eta times the shear, and what two rows exchange stays below the bound.
TEST(Stresslet, MomentOfTheForcesOnTheRowsIsThatOfTheSphere) {
  for (const Real spacing : {7e-5, 1e-4, 1.3e-4}) {
    const test::HostGrid host = even_rows(spacing);
    const GridRef grid = host.ref();
    for (Real y = 1e-3; y < 1.3e-3; y += 3e-6) {
      const GrainKinematics grain = grain_at(y, {0.1, 0, 0});
      const GrainRows rows(grid, y, kRadius);
      const Real rate = Stresslet{kMu}(grid, rows, grain, {}, 0.3, 0), shear = 50;
      if (rows.n < 2) {
        EXPECT_EQ(rate, 0);
        continue;
      }
      Real mean = 0, moment = 0;
      for (int q = 0; q < rows.n; ++q) mean += rows.weight(q) * shear * rows.height(grid, q);
      for (int q = 0; q < rows.n; ++q)
        moment += rate * rows.weight(q) * (shear * rows.height(grid, q) - mean) *
                  grid.y_centre(rows.row[q]);
      const Real sphere = kMu * sphere_volume(kRadius) * viscosity_of_grains(0.3) * shear;
      EXPECT_NEAR(moment / sphere, 1, 1e-9) << y;
      if (rows.n == 2) {
        EXPECT_LT(rate * rows.weight(0) * rows.weight(1), Stresslet{kMu}.most(kRadius)) << y;
      }
    }
  }
}

TEST(Stresslet, CountsAsFarAsAGrainFollowsItsFluid) {
  const test::HostGrid host = even_rows(1e-4);
  const GridRef grid = host.ref();
  const Real y = grid.y_face(11), beta = 1e-7;
  const GrainRows rows(grid, y, kRadius);
  const auto rate = [&](const Vec3& u, const Vec3& slip, Real of_drag) {
    return Stresslet{kMu}(grid, rows, grain_at(y, u), slip, 0.1, of_drag);
  };
  const Real whole = rate({0, 0.3, 0.1}, {}, beta);
  EXPECT_GT(whole, 2 * beta);
  EXPECT_EQ(rate({0, 0.3, 0}, {}, beta), beta) << "at rest along the floor";
  EXPECT_NEAR(rate({0.06, 0, 0.08}, {0, 9, 0.1}, beta), (whole + beta) / 2, 1e-15);
  EXPECT_EQ(rate({0.1, 0, 0}, {}, 2 * whole), 2 * whole) << "stiffer is its drag";
  EXPECT_EQ(Stresslet{}(grid, rows, grain_at(y, {0.1, 0, 0}), {}, 0.1, beta), beta);
}

}  // namespace
}  // namespace barchan
