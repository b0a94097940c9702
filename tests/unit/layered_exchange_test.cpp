// Flow that a grain sees in each row of cells that it lies in.
#include "kernels/coupling/layered_exchange.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

/// The rows of a grain and the velocities that it sees there.
struct Seen {
  GrainRows rows;
  LayerVelocity velocity;

  Seen(const DepositStencil& stencil, const PeriodicBox& box, const ConstFaceRef& u,
       const GrainKinematics& grain, Real solid_per_fluid)
      : rows(stencil.rows_of(grain)),
        velocity(rows, {stencil.grid, box, grain.x}, u, solid_per_fluid) {}
  Seen(const Seen&) = delete;
};

/// Velocities that a grain of 0.2 mm sees in a fluid whose cells (i, j, k) move with u(i, j, k)
/// along x and -2 u along z. Rows grow from 0.26 mm upwards.
struct Water {
  test::HostGrid host{make_grid(7, 5, 0.0112, 0.008, row_faces({0.004, 9, 2.6e-4}))};
  GridRef grid = host.ref();

  Seen at(const Vec3& point, Real solid_per_fluid,
          const std::function<Real(int, int, int)>& u) const {
    const auto x = test::host_field(grid, u);
    const auto z = test::host_field(grid, [&](int i, int j, int k) { return -2 * u(i, j, k); });
    const ConstFieldRef along_x = x.ref(), along_z = z.ref();
    const GrainKinematics grain{.x = point, .r = 1e-4, .u = {}, .m = 1, .omega = {}};
    return {deposit_stencil_in(grid, PointModel::divided, false),
            PeriodicBox{.lx = 0, .lz = grid.lz}, ConstFaceRef{along_x, along_x, along_z}, grain,
            solid_per_fluid};
  }
  /// Velocities in a fluid whose rows j move with u(j).
  Seen at(Real y, const std::function<Real(int)>& u) const {
    return at({0.004, y, 0.003}, 0, [&](int, int j, int) { return u(j); });
  }
  /// Height within row 4, above its middle.
  Real off_centre() const { return grid.y_centre(4) + 5e-5; }
};

TEST(LayeredExchange, AGrainInOneRowSeesALinearProfile) {
  const Water w;
  const auto seen = w.at(w.off_centre(), [&](int j) { return 3 * w.grid.y_centre(j); });
  EXPECT_EQ(seen.rows.n, 1);
  EXPECT_NEAR(seen.velocity.x.over_grain, 3 * w.off_centre(), 1e-14);
  EXPECT_NEAR(seen.velocity.z.over_grain, -6 * w.off_centre(), 1e-14);
}

// Rising ever faster, rising ever slower: the slope of the flatter side, also on growing rows.
TEST(LayeredExchange, TheSlopeInARowIsTheFlatterOneAndMakesNoExtremum) {
  const Water w;
  const auto expect_slope_of_side = [&](int side, const std::function<Real(Real)>& profile) {
    const auto u = [&](int j) { return profile(w.grid.y_centre(j)); };
    const Real slope = (u(4 + side) - u(4)) / (w.grid.y_centre(4 + side) - w.grid.y_centre(4));
    EXPECT_NEAR(w.at(w.off_centre(), u).velocity.x.over_grain, u(4) + slope * 5e-5, 1e-14);
  };
  expect_slope_of_side(-1, [](Real y) { return 1e3 * y * y; });
  expect_slope_of_side(1, [](Real y) { return std::sqrt(y); });
  EXPECT_EQ(w.at(w.off_centre(), [](int j) { return j == 4 ? 1 : 0; }).velocity.x.over_grain, 1);
}

// Half of the grain lies in either row; neither sees the velocity of the other.
TEST(LayeredExchange, AGrainBetweenTwoRowsSeesEachByItsPart) {
  const Water w;
  const auto seen = w.at(w.grid.y_face(4), [](int j) { return j < 4 ? 0 : 1; });
  ASSERT_EQ(seen.rows.n, 2);
  EXPECT_NEAR(seen.velocity.x.over_grain, 0.5, 1e-14);
  for (const auto& x : seen.velocity.x.in_row) {
    EXPECT_EQ(x[seen.rows.find(3)], 0);
    EXPECT_EQ(x[seen.rows.find(4)], 1);
  }
}

// A shear across the flow is seen exactly; a step beside the grain's column is not seen.
TEST(LayeredExchange, AcrossTheFlowASlopeMakesNoExtremum) {
  const Water w;
  const Vec3 point{0.004, w.off_centre(), 2.3 * w.grid.dz};
  const auto shear = w.at(point, 1, [&](int, int, int k) { return 7 * w.grid.z_centre(k); });
  EXPECT_NEAR(shear.velocity.x.over_grain, 7 * point.z, 1e-14);
  const auto step = w.at(point, 1, [](int, int, int k) { return k < 2 ? 100 : 1; });
  EXPECT_EQ(step.velocity.x.over_grain, 1);
}

// A grain between an open and a dense momentum cell: alone it belongs to both, among others to its
// own.
TEST(LayeredExchange, AmongOthersAGrainBelongsToTheNearerMomentumCell) {
  const Water w;
  const auto seen = [&](Real part, Real solid_per_fluid) {
    const Vec3 point{(2 + part) * w.grid.dx, w.off_centre(), 2.5 * w.grid.dz};
    const auto at = w.at(point, solid_per_fluid, [](int i, int, int) { return i < 3 ? 1 : 0; });
    EXPECT_NEAR(at.velocity.x_faces.weight(0) + at.velocity.x_faces.weight(1), 1, 1e-15);
    return at.velocity.x.over_grain;
  };
  EXPECT_NEAR(seen(0.3, 0), 0.7, 1e-12);
  EXPECT_NEAR(seen(0.8, 0), 0.2, 1e-12);
  EXPECT_EQ(seen(0.4, 1), 1);
  EXPECT_EQ(seen(0.6, 1), 0);
  EXPECT_NEAR(seen(0.52, 1), 0.5 - 0.02 * 9, 1e-12);  // the width between them is a ninth
}

// The velocities of two cells that a grain joins come nearer to each other, and do not overshoot.
TEST(LayeredExchange, AGrainJoinsItsFacesNoHarderThanTheWaterStands) {
  for (const Real part : {0.0, 0.1, 0.46, 0.5, 0.97}) {
    const GrainFaces faces(LinearStencil{3, part}, 0.2);
    const Real both = faces.weight(0) * faces.weight(1);
    EXPECT_EQ(faces.limiter(0.9), 1) << part;
    for (const Real K : {0.0, 1.0, 4.0, 1e3, 1e9})
      EXPECT_LE(both * faces.limiter(K) * K, 0.25 + 1e-15) << part << ", K = " << K;
  }
  EXPECT_NEAR(GrainFaces(LinearStencil{3, 0.5}, 1).limiter(8), 1.0 / 8, 1e-15);
}

}  // namespace
}  // namespace barchan
