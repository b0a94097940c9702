// Markers, their delta, and the sums over the water inside a grain.
#include <gtest/gtest.h>

#include "kernels/coupling/inner_momentum.hpp"
#include "src/parallel/mirror.hpp"
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
      sum += line.weight[q], moment += line.weight[q] * (line.at + q - s);
      square += line.weight[q] * line.weight[q];
      const Real r = std::abs(line.at + q - s);
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

TEST(Markers, DeltaAtWalls) {
  for (const Real s : {-40.0, -0.9, 0.1, 0.6, 3.4, 7.2, 7.9, 40.0}) {
    const DeltaLine walled = walled_delta_line(s, 0, 7);
    Real inside = 0;
    for (int q = 0; q < 3; ++q) {
      const bool is_inside = walled.at + q >= 0 && walled.at + q <= 7;
      EXPECT_TRUE(is_inside || walled.weight[q] == 0) << s;
      inside += is_inside ? walled.weight[q] : 0;
    }
    EXPECT_NEAR(inside, 1, 1e-15) << s;
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

/// Copies the flow to a patch of a grain, and counts the faces.
int copy_to_patch(const GrainPatch& patch, const PatchCorner& corner, const ConstFaceRef& flow,
                  std::vector<Real>& values) {
  int faces = 0;
  values.assign(static_cast<std::size_t>(patch.size()), 0);
  for (int row = 0; row < patch.rows(); ++row) {
    const int direction = row / (patch.n[1] * patch.n[2]);
    const ConstFieldRef& u = direction == 0 ? flow.x : direction == 1 ? flow.y : flow.z;
    patch.each_run(corner, row, [&](int at, int i, int j, int k, int n) {
      for (int q = 0; q < n; ++q) values[static_cast<std::size_t>(at + q)] = u(i + q, j, k);
      faces += n;
    });
  }
  return faces;
}

TEST(Markers, ReadASolidMotionExactly) {
  SolidFlow solid;
  const test::HostGrid h(solid.grid);
  const HostField x = to_host(solid.flow.x), y = to_host(solid.flow.y), z = to_host(solid.flow.z);
  const GrainPatch patch = GrainPatch::of(h.ref(), 4.3 * SolidFlow::h, 1.5, SolidFlow::h);
  std::vector<Real> values;
  for (const Vec3& at : {Vec3{0.71, 0.83, 1.14}, Vec3{1.4, 1.27, 0.7}, Vec3{1, 0.95, 0.75}}) {
    const PatchCorner corner = patch.corner(at);
    EXPECT_EQ(copy_to_patch(patch, corner, {x.ref(), y.ref(), z.ref()}, values),
              patch.rows() * patch.n[0]);
    for (int m = 0; m < 50; ++m) {
      const Vec3 marker = at + 4.3 * SolidFlow::h * marker_direction(m, 50);
      const Vec3 read = MarkerLines(patch, corner, marker).mean(patch, values.data());
      EXPECT_LT(norm(read - solid.u - cross(solid.omega, marker - solid.centre)), 1e-13);
    }
  }
}

/// Where a grain lies over an end of the box, or in a box that is narrower than its patch, its
/// faces are those of the cells that repeat.
TEST(Markers, PatchGoesOnOverTheEndsOfAPeriod) {
  const Grid grid = stretched_grid({6, 20, 20}, {0.6, 2, 2}, 0);
  FaceVector flow = make_faces("test: flow", grid);
  const auto wave = [](Real x, Real z) {
    return std::sin(10.0 / 3 * M_PI * x) + std::cos(M_PI * z);
  };
  set_faces(flow, grid, [&](std::size_t, Real x, Real y, Real z) { return wave(x, z) + y; });
  const test::HostGrid h(grid);
  const HostField x = to_host(flow.x), y = to_host(flow.y), z = to_host(flow.z);
  const GrainPatch patch = GrainPatch::of(h.ref(), 0.43, 1.5, 0.1);
  std::vector<Real> values;
  for (const Vec3& at : {Vec3{0.03, 0.1, 1.98}, Vec3{-0.3, 1.9, -0.05}, Vec3{0.59, 5, 2.3}}) {
    const PatchCorner corner = patch.corner(at);
    copy_to_patch(patch, corner, {x.ref(), y.ref(), z.ref()}, values);
    for (int direction = 0; direction < 3; ++direction)
      for (int c = 0; c < patch.n[2]; ++c)
        for (int b = 0; b < patch.n[1]; ++b)
          for (int a = 0; a < patch.n[0]; ++a) {
            const auto place = [&](int axis, int n) {
              return 0.1 * (corner.of(axis, direction) + n + (axis == direction ? 0 : 0.5));
            };
            const int row = corner.of(1, direction) + b;
            const bool is_inside = row >= 0 && row < 20;
            const Real value = values[static_cast<std::size_t>(patch.place(direction, a, b, c))];
            EXPECT_NEAR(value, is_inside ? wave(place(0, a), place(2, c)) + place(1, b) : 0, 1e-13);
          }
    for (int k = 0; k < 20; ++k) {
      const int plane = patch.plane(corner, 2, k);
      EXPECT_EQ((corner.of(2, 2) + plane - k) % 20, 0);
    }
  }
}

/// Water at rest gets the impulse of the markers of a grain that moves and spins, and its moment
/// about the centre, to rounding.
TEST(Markers, WaterGetsTheirImpulseAndItsMoment) {
  constexpr Real h = SolidFlow::h, density = 1000, mass = density * h * h * h;
  const Grid grid = stretched_grid({20, 20, 20}, {2, 2, 2}, 0);
  FaceVector u = make_faces("test: u", grid);
  GrainKinematics grain;
  grain.x = {1.03, 0.98, 1.06}, grain.u = {0.3, -0.2, 0.1}, grain.omega = {2, -1, 3};
  grain.r = 0.435;
  std::vector<Vec3> directions(static_cast<std::size_t>(markers_on_sphere(4)));
  const int n = static_cast<int>(directions.size());
  for (int m = 0; m < n; ++m) directions[static_cast<std::size_t>(m)] = marker_direction(m, n);
  const Markers markers{.direction = to_device("test: directions", directions),
                        .grains = to_device("test: grain", std::vector{grain}),
                        .retraction = 0.35 * h,
                        .n = n};
  const GrainPatch patch = GrainPatch::of(grid, 4 * h, kReachOfDelta, h);
  const MarkerValues values{
      .patch = Kokkos::View<Real*>("test: patch", static_cast<std::size_t>(patch.size())),
      .read = Kokkos::View<Vec3*>("test: read", directions.size()),
      .given = Kokkos::View<Vec3*>("test: given", directions.size())};
  const Kokkos::View<ImpulseOnWater*> impulse("test: impulse", 1);
  const auto teams = [](int count) { return Kokkos::TeamPolicy<>(count, kOnHost ? 1 : 32); };
  Kokkos::parallel_for("test: spread", teams(1), SpreadSlip{patch, markers, h, values});
  Kokkos::parallel_for("test: add", teams(grid.nz),
                       AddToFlow{patch, markers.grains, 1, values.patch, FaceRef(u)});
  Kokkos::parallel_for("test: sum", teams(1),
                       SumOfMarkers{markers, h, h * h * h, density, values.given, impulse});
  const HostField x = to_host(u.x), y = to_host(u.y), z = to_host(u.z);
  ImpulseOnWater got;
  const auto add = [&](const Vec3& place, const Vec3& velocity) {
    got += {mass * velocity, mass * cross(place - grain.x, velocity)};
  };
  for_owned_cells(grid, [&](int i, int j, int k) {
    const Vec3 face{i * h, j * h, k * h}, half{h / 2, h / 2, h / 2};
    add(face + Vec3{0, half.y, half.z}, {x(i, j, k), 0, 0});
    add(face + Vec3{half.x, 0, half.z}, {0, y(i, j, k), 0});
    add(face + Vec3{half.x, half.y, 0}, {0, 0, z(i, j, k)});
  });
  const ImpulseOnWater given = host_copy(impulse)(0);
  EXPECT_GT(norm(given.angular), 0.1 * grain.r * norm(given.linear));
  EXPECT_LT(norm(got.linear - given.linear), 1e-13 * norm(given.linear));
  EXPECT_LT(norm(got.angular - given.angular), 1e-13 * norm(given.angular));
}

TEST(InnerMomentum, IsThatOfASolidMotion) {
  SolidFlow solid;
  const test::HostGrid h(solid.grid);
  const HostField x = to_host(solid.flow.x), y = to_host(solid.flow.y), z = to_host(solid.flow.z);
  GrainKinematics grain;
  grain.x = solid.centre, grain.r = 0.42;
  const GrainPatch patch = GrainPatch::of(h.ref(), grain.r, 0.5, SolidFlow::h);
  const AddInnerFaces add{patch, {x.ref(), y.ref(), z.ref()}};
  InnerSums sums;
  for (int row = 0; row < patch.rows(); ++row) add(grain, patch.corner(grain.x), row, sums);
  EXPECT_LT(norm(sums.velocity() - solid.u), 0.02 * norm(solid.u));      // the centre of the faces
  EXPECT_LT(norm(sums.spin() - solid.omega), 2e-3 * norm(solid.omega));  // products of a and b
  const Real volume = sums.x.w * std::pow(SolidFlow::h, 3);
  EXPECT_NEAR(volume / sphere_volume(grain.r), 1, 0.02);
}

}  // namespace
}  // namespace barchan
