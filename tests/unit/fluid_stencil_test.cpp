// Stencils on fields whose derivatives are known, on a grid that tells the axes apart.
#include <gtest/gtest.h>

#include "kernels/fluid/flow_sums.hpp"
#include "kernels/fluid/interpolation.hpp"
#include "kernels/fluid/momentum.hpp"
#include "kernels/fluid/stencil.hpp"
#include "kernels/fluid/wale.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

// Const fields can be read, not written.
static_assert(std::is_convertible_v<Field&, FieldRef>);
static_assert(std::is_convertible_v<const Field&, ConstFieldRef>);
static_assert(!std::is_convertible_v<const Field&, FieldRef>);
static_assert(!std::is_convertible_v<const FaceVector&, FaceRef>);
static_assert(!std::is_convertible_v<ConstFieldRef, FieldRef>);

using test::HostGrid;

Grid awkward_grid() { return test::stretched_grid({8, 5, 12}, {0.4, 0.3, 0.9}, 0.02); }

/// (1, 2, 3) + g x.
constexpr Mat3 kGradient{
    .xx = 1, .xy = -2, .xz = 3, .yx = 4, .yy = -5, .yz = 6, .zx = 7, .zy = 8, .zz = 9};
Vec3 linear_flow(double x, double y, double z) {
  const Mat3& g = kGradient;
  return {1 + g.xx * x + g.xy * y + g.xz * z, 2 + g.yx * x + g.yy * y + g.yz * z,
          3 + g.zx * x + g.zy * y + g.zz * z};
}

/// A share of it and parabolas along x and z, on the faces.
FaceVector linear_and_parabola(const Grid& grid, double linear, double parabola) {
  const FaceVector u = make_faces("test", grid);
  test::set_faces(u, grid, [&](std::size_t axis, double x, double y, double z) {
    const Vec3 v = linear * linear_flow(x, y, z);
    return axis == 1 ? v.y : (axis == 0 ? v.x : v.z) + parabola * y * y;
  });
  return u;
}

struct StoreGradient {
  Grid grid;
  FaceVector u;
  Kokkos::View<Mat3****> out;
  KOKKOS_FUNCTION void operator()(int i, int j, int k) const {
    out(i, j, k, 0) = gradient_at_cell(grid, u, i, j, k);
  }
};

TEST(FluidStencil, CurlAtAPointIsExactForLinearFields) {
  const Grid grid = awkward_grid();
  const HostGrid h(grid);
  const FaceVector u = linear_and_parabola(grid, 1, 0);
  const test::HostField x = test::to_host(u.x), y = test::to_host(u.y), z = test::to_host(u.z);
  const ConstFaceRef host{x.ref(), y.ref(), z.ref()};
  const Mat3& g = kGradient;
  for (const Vec3& point : {Vec3{0.201, 0.013, 0.33}, Vec3{0.149, 0.002, 0.79},
                            Vec3{0.07, 0.27, 0.45}, Vec3{0.33, 0.151, 0.11}}) {
    const Vec3 curl = interpolate_curl(host, h.ref(), PointStencil(h.ref(), {}, point));
    EXPECT_NEAR(curl.x, g.zy - g.yz, 1e-10);
    EXPECT_NEAR(curl.y, g.xz - g.zx, 1e-10);
    EXPECT_NEAR(curl.z, g.yx - g.xy, 1e-10);
  }
}

TEST(FluidStencil, GradientAtAPointIsExactForLinearFields) {
  const Grid grid = awkward_grid();
  const HostGrid h(grid);
  const Vec3 slope{3, -7, 5};
  const test::HostField host = test::host_field(grid, [&](int i, int j, int k) {
    return dot(slope, {(i + 0.5) * grid.dx, h.y(j), (k + 0.5) * grid.dz});
  });
  for (const Vec3& point : {Vec3{0.201, 0.013, 0.33}, Vec3{0.07, 0.27, 0.45}}) {
    const PointStencil at(h.ref(), {}, point);
    EXPECT_NEAR(norm(interpolate_gradient(host.ref(), h.ref(), at) - slope), 0, 1e-10);
  }
}

TEST(FluidStencil, GradientIsExactForLinearFieldsAndParabolasInY) {
  const Grid grid = awkward_grid();
  const HostGrid h(grid);
  const Kokkos::View<Mat3****> out("gradient", grid.nx, grid.ny, grid.nz, 1);
  for_each_cell("test", grid, StoreGradient{grid, linear_and_parabola(grid, 1, 10), out});
  const auto got = host_copy(out);
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    const Mat3 a = got(i, j, k, 0), &g = kGradient;
    // The ghost rows mirror the height of the first row, so parabolas hold there, too.
    const double extra = 20 * h.y(j);
    EXPECT_NEAR(a.xx, g.xx, 1e-11);
    EXPECT_NEAR(a.xy, g.xy + extra, 1e-11);
    EXPECT_NEAR(a.xz, g.xz, 1e-11);
    EXPECT_NEAR(a.yx, g.yx, 1e-11);
    EXPECT_NEAR(a.yy, g.yy, 1e-11);
    EXPECT_NEAR(a.yz, g.yz, 1e-11);
    EXPECT_NEAR(a.zx, g.zx, 1e-11);
    EXPECT_NEAR(a.zy, g.zy + extra, 1e-11);
    EXPECT_NEAR(a.zz, g.zz, 1e-11);
  });
}

struct StoreFaces {
  Grid grid;
  StressDivergence stress;
  ConvectiveAcceleration convective;
  FaceRef tau, acceleration;
  KOKKOS_FUNCTION void operator()(int i, int j, int k) const {
    tau.x(i, j, k) = stress.x(i, j, k);
    tau.y(i, j, k) = stress.y(i, j, k);
    tau.z(i, j, k) = stress.z(i, j, k);
    acceleration.x(i, j, k) = convective.x(i, j, k);
    acceleration.y(i, j, k) = convective.y(i, j, k);
    acceleration.z(i, j, k) = convective.z(i, j, k);
  }
};

TEST(FluidStencil, StressOfAParabolaAndConvectionOfALinearFlow) {
  const Grid grid = awkward_grid();
  const HostGrid h(grid);
  FaceVector tau = make_faces("test", grid), acceleration = make_faces("test", grid);
  Field nu_t("nu_t", grid);
  Kokkos::deep_copy(nu_t.storage, Real(0.25));
  const FaceVector u = linear_and_parabola(grid, 1, 0);
  const FaceVector parabola = linear_and_parabola(grid, 0, 10);
  for_each_cell("test", grid,
                StoreFaces{grid, {grid, parabola, nu_t, 0.5}, {grid, u}, tau, acceleration});
  const auto tau_x = test::to_host(tau.x), tau_y = test::to_host(tau.y),
             ax = test::to_host(acceleration.x), ay = test::to_host(acceleration.y),
             az = test::to_host(acceleration.z);
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    if (j == 0 || j == grid.ny - 1) return;
    // Second difference of 10 y^2 between centres on a stretched row: 20 (h- + h+) / (2 dy).
    const double height = 0.5 * (h.y(j + 1) - h.y(j - 1));
    EXPECT_NEAR(tau_x(i, j, k), 0.75 * 20 * height / h.dy(j), 1e-9);
    EXPECT_NEAR(tau_y(i, j, k), 0, 1e-9);
    const Mat3& g = kGradient;
    const Vec3 on_x = linear_flow(h.x_face(i), h.y(j), h.z(k));
    EXPECT_NEAR(ax(i, j, k), dot({g.xx, g.xy, g.xz}, on_x), 1e-10);
    const Vec3 on_y = linear_flow(h.x(i), h.y_face(j), h.z(k));
    EXPECT_NEAR(ay(i, j, k), dot({g.yx, g.yy, g.yz}, on_y), 1e-10);
    const Vec3 on_z = linear_flow(h.x(i), h.y(j), h.z_face(k));
    EXPECT_NEAR(az(i, j, k), dot({g.zx, g.zy, g.zz}, on_z), 1e-10);
  });
}

// Each velocity counts for the volume around its face: v = 1 for that between the centres of the
// lowest and the highest row, u and w for all.
TEST(FluidStencil, KineticEnergyWeighsFacesWithTheirVolumes) {
  const Grid grid = awkward_grid();
  const HostGrid h(grid);
  for (const std::size_t moving : {0u, 1u, 2u}) {
    const FaceVector u = make_faces("test", grid);
    test::set_faces(u, grid, [&](std::size_t axis, double, double y, double) {
      return axis == moving && (axis != 1 || y > 1e-9) ? 1.0 : 0.0;
    });
    const Field alpha("alpha", grid);
    Kokkos::deep_copy(alpha.storage, Real(0.5));
    const Real energy = sum_each_cell("test", grid, KineticEnergy{grid, u, alpha});
    const double height = moving == 1 ? h.y(grid.ny - 1) - h.y(0) : 0.3;
    EXPECT_NEAR(energy / (grid.nx * grid.nz), 0.25 * height, 1e-14);
  }
}

// div((nu + nu_t) 2S) of a linear flow is 2S grad(nu_t): exact for parabolas along x and z.
TEST(FluidStencil, StressOfALinearFlowInAVaryingViscosity) {
  const Grid grid = awkward_grid();
  const HostGrid h(grid);
  FaceVector tau = make_faces("test", grid), acceleration = make_faces("test", grid);
  const Field nu_t("nu_t", grid);
  const double c = 0.7;
  test::set_everywhere(nu_t, h.ref(),
                       [&](int i, int, int k) { return c * (h.x(i) * h.x(i) + h.z(k) * h.z(k)); });
  const FaceVector u = linear_and_parabola(grid, 1, 0);
  for_each_cell("test", grid, StoreFaces{grid, {grid, u, nu_t, 0.5}, {grid, u}, tau, acceleration});
  const auto x = test::to_host(tau.x), y = test::to_host(tau.y), z = test::to_host(tau.z);
  const Mat3& g = kGradient;
  const double xx = 2 * g.xx, xy = g.xy + g.yx, xz = g.xz + g.zx, yz = g.yz + g.zy, zz = 2 * g.zz;
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    EXPECT_NEAR(x(i, j, k), 2 * c * (xx * h.x_face(i) + xz * h.z(k)), 1e-9);
    EXPECT_NEAR(y(i, j, k), 2 * c * (xy * h.x(i) + yz * h.z(k)), 1e-9);
    EXPECT_NEAR(z(i, j, k), 2 * c * (xz * h.x(i) + zz * h.z_face(k)), 1e-9);
  });
}

/// Content of the face of a direction ('x', 'y' or 'z'): mean times the face cell's height. The
/// half cells at the walls belong to the lowest and highest face.
struct FaceContent {
  Grid grid;
  ConstFieldRef alpha;
  char axis;
  KOKKOS_FUNCTION Real operator()(int i, int j, int k) const {
    if (axis == 'x') return cell_to_xface(alpha, i, j, k) * grid.dy(j);
    if (axis == 'z') return cell_to_zface(alpha, i, j, k) * grid.dy(j);
    const int ny = grid.ny;
    Real content = j > 0 ? cell_to_yface(grid, alpha, i, j, k) * grid.dy_centre(j)
                         : alpha(i, 0, k) * grid.dy(0) / 2;
    if (j == ny - 1) content += alpha(i, ny - 1, k) * grid.dy(ny - 1) / 2;
    return content;
  }
};

TEST(FluidStencil, FaceMeansKeepTheVolume) {
  const Grid grid = awkward_grid();
  Field alpha("alpha", grid);
  test::set_random(alpha, grid, 1);
  Boundary(grid, WallFlow::no_slip, WallFlow::free_slip).fill(alpha, FieldKind::scalar);
  const double cells = sum_each_cell("test", grid, HeightSum{grid, alpha});
  for (const char axis : {'x', 'y', 'z'}) {
    EXPECT_NEAR(sum_each_cell("test", grid, FaceContent{grid, alpha, axis}), cells, 1e-12) << axis;
  }
}

TEST(FluidStencil, GhostsFollowTheTable) {
  const Grid grid = awkward_grid();
  const Boundary boundary(grid, WallFlow::no_slip, WallFlow::free_slip);
  Field f("f", grid);
  const int ny = grid.ny, nx = grid.nx, nz = grid.nz;
  const auto filled = [&](FieldKind kind) {
    test::set_random(f, grid, 2);
    boundary.fill(f, kind);
    return test::to_host(f);
  };
  for (const FieldKind kind :
       {FieldKind::velocity_x, FieldKind::velocity_z, FieldKind::eddy_viscosity}) {
    const auto h = filled(kind);
    EXPECT_EQ(h(3, -1, 4), -h(3, 0, 4));
    EXPECT_EQ(h(3, ny, 4), h(3, ny - 1, 4));
    EXPECT_EQ(h(-1, 2, 4), h(nx - 1, 2, 4));
    EXPECT_EQ(h(nx, 2, 4), h(0, 2, 4));
    EXPECT_EQ(h(3, 2, -1), h(3, 2, nz - 1));
    EXPECT_EQ(h(-1, -1, nz), -h(nx - 1, 0, 0));
  }
  const auto v = filled(FieldKind::velocity_y);
  EXPECT_EQ(v(3, 0, 4), 0);
  EXPECT_EQ(v(3, ny, 4), 0);
  EXPECT_EQ(v(3, -1, 4), -v(3, 1, 4));
  const auto p = filled(FieldKind::scalar);
  EXPECT_EQ(p(3, -1, 4), p(3, 0, 4));
  EXPECT_EQ(p(3, ny, 4), p(3, ny - 1, 4));
}

}  // namespace
}  // namespace barchan
