// Markers, their delta, and the sums over the water inside a grain.
#include <gtest/gtest.h>

#include "kernels/coupling/inner_momentum.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

using namespace test;

TEST(Markers, DeltaKeepsSumAndFirstMoment) {
  Real squares = -1;
  for (Real s = -2; s < 2; s += 0.037) {
    const DeltaLine line = delta_line(s);
    Real sum = 0, moment = 0, square = 0;
    for (int q = 0; q < 3; ++q) {
      sum += line.weight[q], moment += line.weight[q] * (line.at[q] - s);
      square += line.weight[q] * line.weight[q];
      const Real r = std::abs(line.at[q] - s);
      const Real phi = r < 0.5 ? (1 + std::sqrt(1 - 3 * r * r)) / 3
                               : (5 - 3 * r - std::sqrt(1 - 3 * (1 - r) * (1 - r))) / 6;
      EXPECT_NEAR(line.weight[q], phi, 1e-14);
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_NEAR(moment, 0, 1e-14);
    if (squares < 0) squares = square;
    EXPECT_NEAR(square, 0.5, 1e-14) << "Roma et al., equation 21";
  }
}

TEST(Markers, DeltaAtWallsAndEndsOfAPeriod) {
  for (const Real s : {-0.9, 0.1, 0.6, 7.2, 7.9}) {
    const DeltaLine walled = walled_delta_line(s, 0, 7), round = periodic_delta_line(s - 16, 8);
    Real sum = 0;
    for (int q = 0; q < 3; ++q) {
      sum += walled.weight[q];
      for (const int at : {walled.at[q], round.at[q]}) EXPECT_TRUE(at >= 0 && at < 8) << s;
      EXPECT_EQ(round.weight[q], delta_line(s - 16).weight[q]);
    }
    EXPECT_NEAR(sum, 1, 1e-15);
  }
}

TEST(Markers, AreEvenOnTheSphere) {
  for (const Real radius : {2.7, 4.7, 9.7}) {
    const int n = markers_on_sphere(radius);
    EXPECT_NEAR(marker_volume(radius, n), 1, 0.03);
    Vec3 sum;
    Real squares[3] = {};
    for (int m = 0; m < n; ++m) {
      const Vec3 e = marker_direction(m, n);
      EXPECT_NEAR(norm(e), 1, 1e-14);
      sum += e;
      squares[0] += e.x * e.x, squares[1] += e.y * e.y, squares[2] += e.z * e.z;
    }
    EXPECT_LT(norm(sum) / n, 1e-2);
    for (const Real square : squares) EXPECT_NEAR(square / n, 1.0 / 3, 2e-3);
    // The nearest one is about a cell away.
    Real nearest = 2;
    const Vec3 one = marker_direction(n / 2, n);
    for (int m = 0; m < n; ++m) {
      if (m != n / 2) nearest = std::min(nearest, norm(marker_direction(m, n) - one));
    }
    EXPECT_NEAR(radius * nearest, 0.9, 0.15);
  }
}

/// A box of flow that turns and moves like a solid, and a patch in it.
struct SolidFlow {
  static constexpr Real h = 0.1;
  Vec3 u{0.3, -0.2, 0.1}, omega{2, -1, 3}, centre{1.03, 0.98, 1.06};
  Grid grid = stretched_grid({20, 20, 20}, {2, 2, 2}, 0);
  FaceVector flow = make_faces("test: flow", grid);
  SolidFlow() {
    set_faces(flow, grid, [&](std::size_t axis, Real x, Real y, Real z) {
      const Vec3 v = u + cross(omega, Vec3{x, y, z} - centre);
      return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
    });
  }
};

TEST(Markers, ReadASolidMotionExactly) {
  SolidFlow solid;
  const test::HostGrid h(solid.grid);
  const HostField x = to_host(solid.flow.x), y = to_host(solid.flow.y), z = to_host(solid.flow.z);
  for (const Vec3& at : {Vec3{0.71, 0.83, 1.14}, Vec3{1.5, 1.27, 0.4}}) {
    const Vec3 read = MarkerFaces(h.ref(), at).mean(x, y, z);
    EXPECT_LT(norm(read - solid.u - cross(solid.omega, at - solid.centre)), 1e-13);
  }
}

TEST(InnerMomentum, IsThatOfASolidMotion) {
  SolidFlow solid;
  const test::HostGrid h(solid.grid);
  const HostField x = to_host(solid.flow.x), y = to_host(solid.flow.y), z = to_host(solid.flow.z);
  GrainKinematics grain;
  grain.x = solid.centre, grain.r = 0.42;
  const GrainPatch patch = GrainPatch::of(h.ref(), grain.r + 1.5 * SolidFlow::h, SolidFlow::h);
  const AddInnerFaces add{patch, {x.ref(), y.ref(), z.ref()}};
  InnerSums sums;
  for (int row = 0; row < patch.rows(); ++row) add(grain, row, sums);
  EXPECT_LT(norm(sums.velocity() - solid.u), 0.02 * norm(solid.u));      // the centre of the faces
  EXPECT_LT(norm(sums.spin() - solid.omega), 2e-3 * norm(solid.omega));  // products of a and b
  const Real volume = sums.x.w * std::pow(SolidFlow::h, 3);
  EXPECT_NEAR(volume / sphere_volume(grain.r), 1, 0.02);
}

}  // namespace
}  // namespace barchan
