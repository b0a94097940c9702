// WALE on the grid: its values in known flows and how it dies at a wall.
#include <numbers>

#include "kernels/fluid/wale.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using std::numbers::pi;
using test::HostGrid;

/// nu_t / (C_w Delta)^2 of row j [1/s] for velocities given at any place, ghosts included.
template <class Velocity>
test::HostField wale_rate(const Grid& grid, const Velocity& velocity) {
  const FaceVector u = make_faces("test", grid);
  test::set_faces(u, grid, [&](std::size_t axis, double x, double y, double z) {
    const Vec3 v = velocity(x, y, z);
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
  });
  const Kokkos::View<Real*> one("one", grid.ny);
  Kokkos::deep_copy(one, Real(1));
  Field rate("rate", grid);
  for_each_cell("test", grid, UpdateEddyViscosity{grid, u, rate, one.data()});
  return test::to_host(rate);
}

/// Closed forms of the model (Nicoud & Ducros 1999) in units of a: pure shear 0, plane strain
/// (2/3)^1.5 / (2^2.5 + (2/3)^1.25) a, solid rotation (2/3)^0.25 a.
TEST(WaleOnGrid, KnownFlowsOnStretchedCells) {
  const Grid grid = test::stretched_grid({6, 7, 5}, {0.4, 0.3, 0.9}, 0.02);
  const double a = 7;
  const double strain = std::pow(2.0 / 3, 1.5) / (std::pow(2, 2.5) + std::pow(2.0 / 3, 1.25));
  const double rotation = std::pow(2.0 / 3, 0.25);
  double worst = 0;
  const auto check = [&](const auto& velocity, double expected) {
    const auto rate = wale_rate(grid, velocity);
    test::for_owned_cells(grid, [&](int i, int j, int k) {
      worst = std::max(worst, std::abs(rate(i, j, k) / a - expected));
    });
  };
  check([](double, double, double) { return Vec3{}; }, 0);
  check([=](double, double y, double) { return Vec3{a * y, 0, 0}; }, 0);
  check([=](double, double y, double) { return Vec3{0, 0, a * y}; }, 0);
  check([=](double x, double y, double) { return Vec3{a * x, -a * y, 0}; }, strain);
  check([=](double, double y, double z) { return Vec3{0, a * y, -a * z}; }, strain);
  check([=](double x, double y, double) { return Vec3{-a * y, a * x, 0}; }, rotation);
  check([=](double x, double, double z) { return Vec3{a * z, 0, -a * x}; }, rotation);
  // Strain of equal size with its axes at 45 degrees.
  check([=](double x, double y, double) { return Vec3{a * y, a * x, 0}; }, strain);
  check([=](double, double y, double z) { return Vec3{0, a * z, a * y}; }, strain);
  check([=](double x, double, double z) { return Vec3{a * z, 0, a * x}; }, strain);
  test::expect_below("WALE at rest, in shear, strain, rotation", worst, 1e-14);
  EXPECT_NEAR(strain, 0.0870, 5e-5);
  EXPECT_NEAR(rotation, 0.9036, 5e-5);
}

/// The cube root of the volume of a cell that is wide, deep and flat.
TEST(WaleOnGrid, FilterWidthIsThatOfTheCellsVolume) {
  const Grid grid = test::stretched_grid({6, 7, 5}, {0.4, 0.3, 0.9}, 0.02);
  const HostGrid h(grid);
  const Kokkos::View<Real*> width("width", grid.ny);
  Kokkos::parallel_for("test", grid.ny, FilterWidth{grid, 0.3, width});
  const auto rows = host_copy(width);
  for (int j = 0; j < grid.ny; ++j)
    EXPECT_NEAR(std::pow(rows(j) / 0.3, 3), 0.4 / 6 * h.dy(j) * 0.9 / 5, 1e-14);
}

/// The first terms of a turbulent flow in the distance from a wall, in wall units: u = y f(x, z),
/// w = y g(x, z), v = -y^2 (df/dx + dg/dz) / 2, streaks of 100 by 400. Ten rows within y+ = 5.
TEST(WaleOnGrid, EddyViscosityGrowsWithTheCubeOfTheWallDistance) {
  const double lx = 400, lz = 100;
  const Grid grid = test::stretched_grid({24, 20, 24}, {lx, 10, lz}, 0);
  const HostGrid h(grid);
  const double kx = 2 * pi / lx, kz = 2 * pi / lz;
  const auto velocity = [&](double x, double y, double z) {
    const double f = 1 + 0.3 * std::sin(kx * x) * std::cos(kz * z);
    const double g = 0.2 * std::cos(kx * x + 1) * std::sin(kz * z);
    const double df_dx = 0.3 * kx * std::cos(kx * x) * std::cos(kz * z);
    const double dg_dz = 0.2 * kz * std::cos(kx * x + 1) * std::cos(kz * z);
    return Vec3{y * f, -0.5 * y * std::abs(y) * (df_dx + dg_dz), y * g};  // odd, as the ghosts are
  };
  const auto rate = wale_rate(grid, velocity);
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int j = 0; h.y(j) < 5; ++j) {
    double mean = 0;
    for (int k = 0; k < grid.nz; ++k)
      for (int i = 0; i < grid.nx; ++i) mean += rate(i, j, k);
    const double x = std::log(h.y(j)), y = std::log(mean);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  test::expect_absolute("slope of log nu_t against log y in y+ < 5",
                        (n * sxy - sx * sy) / (n * sxx - sx * sx), 3, 0.15);
}

}  // namespace
}  // namespace barchan
