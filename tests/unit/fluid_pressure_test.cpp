// The direct solver, the smoothing step made of it, and the conjugate gradients.
#include <gtest/gtest.h>

#include <numbers>

#include "kernels/fluid/pressure.hpp"
#include "src/fluid/pressure_solver.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

using std::numbers::pi;
using test::HostGrid;

double volume_dot(const Grid& grid, const Field& a, const Field& b) {
  return grid.dx * grid.dz * sum_each_cell("test", grid, InnerProduct{grid, a, b});
}

/// Volume-weighted RMS error of -lap phi = f for a smooth phi with zero gradient on the walls.
double poisson_error(int n) {
  const Grid grid = test::stretched_grid({n, n / 2, 2 * n}, {1, 0.7, 1.3}, 0.7 / n);
  const HostGrid h(grid);
  const double kx = 2 * pi, ky = pi / 0.7, kz = 4 * pi / 1.3;
  const auto exact = [&](int i, int j, int k) {
    return std::cos(kx * h.x(i)) * std::cos(ky * h.y(j)) * std::sin(kz * h.z(k));
  };
  Field f("f", grid), phi("phi", grid);
  const double factor = kx * kx + ky * ky + kz * kz;
  test::set_field(f, grid, [&](int i, int j, int k) { return factor * exact(i, j, k); });
  PoissonFft(grid, std::make_shared<const PlaneFft>(grid), 0, 1).solve(f, phi);
  const auto got = test::to_host(phi);
  double sum = 0, volume = 0;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        sum += h.volume(j) * std::pow(got(i, j, k) - exact(i, j, k), 2);
        volume += h.volume(j);
      }
  return std::sqrt(sum / volume);
}

TEST(FluidPoisson, SecondOrder) {
  const double coarse = poisson_error(16), fine = poisson_error(32);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

TEST(FluidPoisson, InvertsTheOperatorOnAwkwardSizes) {
  for (const std::array<int, 3> n :
       {std::array{8, 5, 12}, std::array{9, 4, 7}, std::array{6, 3, 1}, std::array{1, 6, 5}}) {
    const Grid grid = test::stretched_grid(n, {0.4, 0.3, 0.9}, 0.2 / n[1]);
    const Halo halo(grid);
    Field f("f", grid), phi("phi", grid);
    test::set_random(f, grid, 3);
    const double mean =
        sum_each_cell("test", grid, HeightSum{grid, f}) / (grid.ly * grid.nx * grid.nz);
    PoissonFft(grid, std::make_shared<const PlaneFft>(grid), 0, 1).solve(f, phi);
    halo.fill(phi);
    FaceVector c = test::make_faces(grid);
    for (const Field& face : {c.x, c.z}) Kokkos::deep_copy(face.storage, Real(1));
    test::set_field(c.y, grid, [](int, int j, int) { return j > 0 ? 1.0 : 0.0; });
    // r = (f - mean) - A phi must vanish; its squares are what InitialResidual adds up.
    for_each_cell("test", grid, Subtract{f, mean});
    EXPECT_LT(sum_each_cell("test", grid, InitialResidual{grid, c, phi, f}), 1e-22);
    EXPECT_NEAR(sum_each_cell("test", grid, HeightSum{grid, phi}), 0, 1e-12);
  }
}

TEST(FluidSmoother, KeepsTheIntegralIsSelfAdjointAndMakesNoNewExtrema) {
  const Grid grid = test::stretched_grid({8, 5, 12}, {0.4, 0.3, 0.9}, 0.02);
  const PoissonFft smoother = make_smoother(grid, std::make_shared<const PlaneFft>(grid), 0.13);
  Field a("a", grid), b("b", grid), smooth_a("sa", grid), smooth_b("sb", grid);
  test::set_random(a, grid, 4);
  test::set_random(b, grid, 5);
  smoother.solve(a, smooth_a);
  smoother.solve(b, smooth_b);
  const double before = sum_each_cell("test", grid, HeightSum{grid, a});
  EXPECT_NEAR(sum_each_cell("test", grid, HeightSum{grid, smooth_a}), before, 1e-14);
  const double left = volume_dot(grid, smooth_a, b), right = volume_dot(grid, a, smooth_b);
  EXPECT_NEAR(left, right, 1e-14 * volume_dot(grid, a, a));

  test::set_field(a, grid, [](int i, int j, int k) { return i == 3 && j == 0 && k == 11; });
  smoother.solve(a, a);  // in place
  const auto spread = test::to_host(a);
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        EXPECT_GE(spread(i, j, k), -1e-16);
        EXPECT_LE(spread(i, j, k), spread(3, 0, 11));
      }
}

/// A heap with a sharp, noisy surface: alpha 0.35..0.5 inside and a strong drag.
FaceVector heap_mobility(const Grid& grid, const Boundary& boundary) {
  const HostGrid h(grid);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0.35, 0.5);
  Field alpha("alpha", grid);
  FaceVector implicit = test::make_faces(grid), c = test::make_faces(grid);
  test::set_field(alpha, grid, [&](int i, int j, int k) {
    const double r = std::hypot(h.x(i) - 0.3 * grid.lx, h.z(k) - 0.5 * grid.lz);
    const double noise = uniform(engine);
    return h.y(j) < 0.16 * grid.ly * (1 - r / 0.013) ? noise : 1.0;
  });
  boundary.fill(alpha, FieldKind::scalar);
  const auto a = test::to_host(alpha);
  for (const Field& m : {implicit.x, implicit.y, implicit.z}) {
    test::set_field(
        m, grid, [&](int i, int j, int k) { return 1000 * (a(i, j, k) < 1 ? 2 * a(i, j, k) : 0); });
  }
  sum_each_cell("test", grid, UpdateMobility{grid, alpha, implicit, 1e-3, c});
  boundary.fill_periodic(c);
  return c;
}

TEST(FluidPressure, IterationsForAHeap) {
  const Grid grid = test::stretched_grid({63, 30, 32}, {0.1, 0.025, 0.05}, 2.625e-4);
  const Boundary boundary(grid, WallFlow::no_slip, WallFlow::free_slip);
  const FaceVector c = heap_mobility(grid, boundary);
  const auto iterations = [&](Preconditioner kind) {
    Field b("b", grid), p("p", grid);
    test::set_random(b, grid, 9);
    SolverConfig config;
    config.preconditioner = kind;
    PressureSolver solver(grid, boundary.halo(), std::make_shared<const PlaneFft>(grid), config);
    const PressureReport report = solver.solve(c, b, p, 1e-6);
    EXPECT_LE(report.residual, 1e-6);
    return report.iterations;
  };
  EXPECT_LE(iterations(Preconditioner::fft), 20);
  EXPECT_LE(iterations(Preconditioner::local_fft), 6);
}

/// The inner product <a, M^-1 b> must not depend on the order, or conjugate gradients mislead.
TEST(FluidPressure, LocalPreconditionerIsSelfAdjointOnOddSizes) {
  const Grid grid = test::stretched_grid({13, 7, 9}, {0.05, 0.025, 0.036}, 1e-3);
  const Boundary boundary(grid, WallFlow::no_slip, WallFlow::free_slip);
  const FaceVector c = heap_mobility(grid, boundary);
  const PoissonFft poisson(grid, std::make_shared<const PlaneFft>(grid), 0, 1);
  LocalCorrection local(grid, boundary.halo());
  local.update(c);
  Field a("a", grid), b("b", grid), ma("ma", grid), mb("mb", grid);
  test::set_random(a, grid, 14);
  test::set_random(b, grid, 15);
  local.apply(poisson, a, ma);
  local.apply(poisson, b, mb);
  const double left = volume_dot(grid, a, mb), right = volume_dot(grid, ma, b);
  EXPECT_NEAR(left, right, 1e-13 * volume_dot(grid, a, ma));
  EXPECT_GT(volume_dot(grid, b, mb), 0);
}

TEST(FluidPressure, UniformMobilityTakesOneIteration) {
  const Grid grid = test::stretched_grid({8, 5, 12}, {0.4, 0.3, 0.9}, 0.02);
  const Boundary boundary(grid, WallFlow::no_slip, WallFlow::free_slip);
  FaceVector c = test::make_faces(grid);
  for (const Field& face : {c.x, c.z}) Kokkos::deep_copy(face.storage, Real(1));
  test::set_field(c.y, grid, [](int, int j, int) { return j > 0 ? 1.0 : 0.0; });
  Field b("b", grid), p("p", grid);
  test::set_random(b, grid, 10);
  PressureSolver solver(grid, boundary.halo(), std::make_shared<const PlaneFft>(grid), {});
  const PressureReport report = solver.solve(c, b, p, 1e-10);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_LE(report.residual, 1e-10);
}

}  // namespace
}  // namespace barchan
