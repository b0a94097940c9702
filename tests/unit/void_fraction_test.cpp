// The 29 points, fixed-point sums, interpolation.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/coupling/cell_point_face.hpp"
#include "kernels/coupling/void_fraction.hpp"
#include "kernels/fluid/interpolation.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

test::HostGrid awkward_grid() {
  return test::HostGrid(make_grid(7, 5, 0.0112, 0.008, row_faces({0.004, 9, 2.6e-4})));
}

TEST(DividedPoints, ShellsAreTheVolumeMeansAndTheCentroidIsTheCentre) {
  const auto mean_radius = [](Real a, Real b) {
    return 0.75 * (std::pow(b, 4) - std::pow(a, 4)) / (std::pow(b, 3) - std::pow(a, 3));
  };
  const Real inner = std::cbrt(1.0 / 29), middle = std::cbrt(15.0 / 29);
  EXPECT_NEAR(kInnerShell, mean_radius(inner, middle), 1e-4);
  EXPECT_NEAR(kOuterShell, mean_radius(middle, 1), 1e-4);
  Vec3 sum;
  int on_inner = 0, on_outer = 0;
  for (int p = 0; p < kDividedPoints; ++p) {
    const Vec3 x = divided_point(p);
    sum += x;
    on_inner += std::abs(norm(x) - kInnerShell) < 1e-12;
    on_outer += std::abs(norm(x) - kOuterShell) < 1e-12;
    for (int q = 0; q < p; ++q) EXPECT_GT(norm(x - divided_point(q)), 0.1) << p << " " << q;
  }
  EXPECT_NEAR(norm(sum), 0, 1e-14);
  EXPECT_EQ(on_inner, 14);
  EXPECT_EQ(on_outer, 14);
}

TEST(DepositStencil, EveryPointGoesToTheCellThatHoldsIt) {
  const test::HostGrid host = awkward_grid();
  const GridRef grid = host.ref();
  const DepositStencil stencil = deposit_stencil_in(grid, PointModel::divided, false);
  std::mt19937_64 generator(4);
  const auto uniform = [&generator] { return static_cast<double>(generator() >> 11) * 0x1.0p-53; };
  int n_short_cuts = 0, n_empty = 0;
  for (int n = 0; n < 300; ++n) {
    // Grains may stick out of the floor, the lid, the outlet and the sides.
    const GrainKinematics g{.x = {0.0112 * uniform(), 0.004 * uniform(), 0.008 * uniform()},
                            .r = 1.25e-4,
                            .u = {},
                            .m = 1,
                            .omega = {}};
    const GrainRows rows(grid, g.x.y, g.r);
    const GrainCells cells = stencil(g);
    Real total = 0;
    for (int q = 0; q < cells.n; ++q) {
      total += cells.weight(q);
      const int j = cells.cell[q].j;
      EXPECT_LE(grid.y_face(j), g.x.y + g.r);
      EXPECT_GE(grid.y_face(j + 1), g.x.y - g.r);
    }
    EXPECT_NEAR(total, 1, 1e-14);
    // Point by point: grains within one column of cells take a short cut.
    std::vector<Real> left(cells.share, cells.share + cells.n);
    for (int p = 0; p < kDividedPoints; ++p) {
      const Vec3 at = g.x + g.r * divided_point(p);
      const int row = rows.find(grid.row_of(at.y));
      const CellIndex c{stencil.place_x(stencil.column_x(at.x)), rows.row[row],
                        stencil.place_z(stencil.column_z(at.z))};
      for (std::size_t q = 0; q < left.size(); ++q)
        left[q] -= cells.cell[q] == c ? rows.weight(row) / std::popcount(rows.points[row]) : 0;
    }
    // A row without points belongs to the column of the centre.
    for (int q = 0; q < cells.n; ++q) {
      const int row = rows.find(cells.cell[q].j);
      const bool empty = rows.points[row] == 0;
      const CellIndex &here = cells.cell[q], &own = cells.cell[0];
      EXPECT_TRUE(!empty || (here.i == own.i && here.k == own.k));
      EXPECT_NEAR(left[static_cast<std::size_t>(q)], empty ? rows.weight(row) : 0, 1e-14);
      n_empty += empty ? 1 : 0;
    }
    bool one_column = true;
    for (int q = 1; q < cells.n; ++q)
      one_column =
          one_column && cells.cell[q].i == cells.cell[0].i && cells.cell[q].k == cells.cell[0].k;
    n_short_cuts += one_column ? 1 : 0;
  }
  EXPECT_GT(n_empty, 5);
  EXPECT_GT(n_short_cuts, 10);
  EXPECT_LT(n_short_cuts, 290);
}

TEST(DepositStencil, PeriodicSidesWrapTheOutletHolds) {
  const test::HostGrid host = awkward_grid();
  const GridRef grid = host.ref();
  const DepositStencil stencil = deposit_stencil_in(grid, PointModel::divided, false);
  const auto along_x = [](const DepositStencil& s, Real x) { return s.place_x(s.column_x(x)); };
  EXPECT_EQ(stencil.place_z(stencil.column_z(-1e-5)), grid.nz - 1);
  EXPECT_EQ(along_x(stencil, 0.01125), grid.nx - 1);
  EXPECT_EQ(along_x(deposit_stencil_in(grid, PointModel::divided, true), 0.01125), 0);
}

TEST(FixedPoint, SumsDoNotDependOnTheOrder) {
  const FixedPoint fixed = fixed_point_for(1000);
  std::vector<Real> values;
  std::mt19937_64 generator(1);
  for (int n = 0; n < 1000; ++n) values.push_back(std::sin(n) * std::exp(-0.01 * n));
  const auto sum = [&] {
    std::int64_t total = 0;
    for (const Real v : values) total += fixed.encode(v);
    return total;
  };
  const std::int64_t forward = sum();
  std::shuffle(values.begin(), values.end(), generator);
  EXPECT_EQ(sum(), forward);
  Real plain = 0;
  for (const Real v : values) plain += v;
  EXPECT_NEAR(fixed.decode(forward), plain, 1e-12);
  EXPECT_LT(fixed.encode(1000), std::int64_t{1} << 62);
  EXPECT_GT(fixed.encode(1000), std::int64_t{1} << 60);
}

TEST(Interpolation, IsExactForLinearFieldsAndVanishesOnANoSlipWall) {
  const test::HostGrid host = awkward_grid();
  const GridRef g = host.ref();
  const auto value = [](Real x, Real y, Real z) { return 1 + 20 * x + 300 * y - 7 * z; };
  const test::HostField u = test::host_field(
      g, [&](int i, int j, int k) { return value(g.x_face(i), g.y_centre(j), g.z_centre(k)); });
  const test::HostField v = test::host_field(
      g, [&](int i, int j, int k) { return value(g.x_centre(i), g.y_face(j), g.z_centre(k)); });
  const test::HostField w = test::host_field(
      g, [&](int i, int j, int k) { return value(g.x_centre(i), g.y_centre(j), g.z_face(k)); });
  const FaceRef f{u.ref(), v.ref(), w.ref()};
  const PeriodicBox box{.lx = 0, .lz = g.lz};
  for (const Vec3& p :
       {Vec3{0.001, 0.0001, 0.001}, Vec3{0.0105, 0.0039, 0.0075}, Vec3{0.00555, 0.0021, 0.0002},
        Vec3{0, 0, 0}, Vec3{0.0112, 0.004, 0.0079}}) {
    const Vec3 at = interpolate_faces(f, PointStencil(g, box, p));
    const Real expected = value(p.x, p.y, p.z);
    EXPECT_NEAR(at.x, expected, 1e-12) << p.x << " " << p.y << " " << p.z;
    EXPECT_NEAR(at.y, expected, 1e-12);
    EXPECT_NEAR(at.z, expected, 1e-12);
  }
  // Ghosts that mirror the velocity make it vanish on the wall.
  for (int k = -1; k <= g.nz; ++k)
    for (int i = -1; i <= g.nx; ++i) f.x(i, -1, k) = -f.x(i, 0, k);
  EXPECT_NEAR(interpolate_faces(f, PointStencil(g, box, {0.003, 0, 0.002})).x, 0, 1e-14);
}

/// Value of a linear field, in cells of one size, at points that fall into all sorts of tetrahedra.
TEST(CellPointFace, IsExactForLinearFieldsInEqualCells) {
  const test::HostGrid host(make_grid(7, 5, 0.0112, 0.008, row_faces({0.0045, 9, 0})));
  const GridRef g = host.ref();
  const auto value = [](Real x, Real y, Real z) { return 1 + 20 * x + 300 * y - 7 * z; };
  const test::HostField f = test::host_field(
      g, [&](int i, int j, int k) { return value(g.x_centre(i), g.y_centre(j), g.z_centre(k)); });
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<Real> share(0, 1);
  const PeriodicBox box{.lx = g.lx, .lz = g.lz};
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p{share(generator) * g.lx, share(generator) * g.ly, share(generator) * g.lz};
    ASSERT_NEAR(CellPointFace(g, box, p)(g, f.ref()), value(p.x, p.y, p.z), 1e-12)
        << p.x << " " << p.y << " " << p.z;
  }
}

/// The four corners of a tetrahedron in stretched rows, from their own definition.
TEST(CellPointFace, HasTheValuesOfTheCornersOfItsTetrahedra) {
  const test::HostGrid host = awkward_grid();
  const GridRef g = host.ref();
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<Real> any(-1, 1);
  const test::HostField f = test::host_field(g, [&](int, int, int) { return any(generator); });
  const ConstFieldRef v = f.ref();
  const PeriodicBox box{.lx = g.lx, .lz = g.lz};
  const auto read = [&](Real x, Real y, Real z) { return CellPointFace(g, box, {x, y, z})(g, v); };
  const int i = 3, j = 4, k = 2;
  const Real x = g.x_centre(i), y = g.y_centre(j), z = g.z_centre(k), most = 1 - 1e-13;
  EXPECT_NEAR(read(x, y, z), v(i, j, k), 1e-14);
  EXPECT_NEAR(read(x + most * g.dx / 2, y, z), (v(i, j, k) + v(i + 1, j, k)) / 2, 1e-11);
  const Real up = g.y_face(j + 1) - y, beyond = g.y_centre(j + 1) - g.y_face(j + 1);
  EXPECT_NEAR(read(x, y + most * up, z),
              (beyond * v(i, j, k) + up * v(i, j + 1, k)) / (up + beyond), 1e-11);
  Real sum = 0, weights = 0;
  for (const auto& [c, row] : {std::pair{up, j}, std::pair{beyond, j + 1}}) {
    const Real w = 1 / std::hypot(g.dx / 2, c, g.dz / 2);
    for (const int a : {i - 1, i})
      for (const int b : {k, k + 1}) sum += w * v(a, row, b), weights += w;
  }
  EXPECT_NEAR(read(x - most * g.dx / 2, y + most * up, z + most * g.dz / 2), sum / weights, 1e-11);
}

}  // namespace
}  // namespace barchan
