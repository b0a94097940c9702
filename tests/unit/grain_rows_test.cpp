// Rows of cells that hold a height, or a grain; sums over the cells of grains.
#include "kernels/coupling/grain_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "kernels/coupling/deposit_cache.hpp"
#include "src/parallel/mirror.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

/// Rows of equal height; rows that grow from half a diameter of a grain of 0.2 mm; one row.
std::array<test::HostGrid, 3> grids() {
  const auto with = [](int ny, double first) {
    return test::HostGrid(make_grid(7, 5, 0.0112, 0.008, row_faces({0.004, ny, first})));
  };
  return {with(11, 0), with(17, 1e-4), with(1, 0)};
}

TEST(Rows, AHeightIsFoundInTheRowThatHoldsIt) {
  for (const test::HostGrid& host : grids()) {
    const GridRef grid = host.ref();
    const auto expect_held = [&grid](Real y) {
      const int j = grid.row_of(y);
      EXPECT_TRUE(grid.y_face(j) <= y && y < grid.y_face(j + 1)) << y << " in " << j;
    };
    std::mt19937_64 generator(2);
    std::uniform_real_distribution<Real> inside(0, 0.004);
    for (int n = 0; n < 2000; ++n) expect_held(inside(generator));
    for (int j = 0; j < grid.ny; ++j) {
      expect_held(grid.y_face(j));
      expect_held(std::nextafter(grid.y_face(j + 1), 0));
    }
    const Real infinity = std::numeric_limits<Real>::infinity();
    for (const Real below : {-1e-9, -1.0, -infinity}) EXPECT_EQ(grid.row_of(below), 0);
    for (const Real above : {grid.ly, 1.0, infinity}) EXPECT_EQ(grid.row_of(above), grid.ny - 1);
  }
}

// Grains smaller and larger than a row, inside and across the floor and the lid.
TEST(Rows, AGrainIsInTheRowsOfItsPoints) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<Real> height(-1e-4, 0.0041), radius(2e-5, 4e-4);
  int of_two_rows = 0;
  for (const test::HostGrid& host : grids()) {
    const GridRef grid = host.ref();
    for (int n = 0; n < 600; ++n) {
      const Real y = height(generator), r = radius(generator);
      const GrainRows rows(grid, y, r);
      of_two_rows += rows.n == 2 ? 1 : 0;
      std::array<Real, kDividedOffsets> sum{}, points{};
      PointSet all = 0, outside = 0;
      for (int p = 0; p < kDividedPoints; ++p) {
        const Real at = y + r * divided_point(p).y;
        if (at < 0 || at > grid.ly) outside |= PointSet{1} << p;
        const int q = rows.find(grid.row_of(mirrored_inside(grid, at)));
        ASSERT_TRUE(rows.points[q] >> p & 1) << "point " << p << " at " << at;
        sum[static_cast<std::size_t>(q)] += mirrored_inside(grid, at);
        points[static_cast<std::size_t>(q)] += 1;
      }
      EXPECT_EQ(rows.row[0], grid.row_of(mirrored_inside(grid, y)));
      EXPECT_EQ(rows.outside, outside);
      for (int q = 0; q < rows.n; ++q) {
        EXPECT_EQ(all & rows.points[q], 0u);
        all |= rows.points[q];
        const int j = rows.row[q];
        const auto at = static_cast<std::size_t>(q);
        const Real above_middle = sum[at] / points[at] - grid.y_centre(j);
        EXPECT_NEAR(rows.over_lower[q] * (grid.y_centre(j) - grid.y_centre(j - 1)), above_middle,
                    1e-15);
        EXPECT_NEAR(rows.over_upper[q] * (grid.y_centre(j + 1) - grid.y_centre(j)), above_middle,
                    1e-15);
        EXPECT_NEAR(rows.weight(q), points[at] / kDividedPoints, 1e-15);
      }
      EXPECT_EQ(all, kAllPoints);
    }
  }
  EXPECT_GT(of_two_rows, 100);
}

// Cells that take the same slot push each other out; what they held is not lost.
TEST(DepositCache, SumsAreThoseOfEachGiftOnItsOwn) {
  constexpr int gifts = 5000;
  const GridRef grid{{.nx = 7, .ny = 11, .nz = 5}};
  const auto cells = static_cast<int>(CellIndex::count(grid));
  Deposits deposits, one_by_one;
  deposits.sum = decltype(deposits.sum)("test: kept", cells);
  one_by_one.sum = decltype(deposits.sum)("test: one by one", cells);
  Kokkos::parallel_for(
      "test: gifts", 1, KOKKOS_LAMBDA(int) {
        DepositCache<8> cache(grid, deposits);
        for (int n = 0; n < gifts; ++n) {
          const int at = n / 3 * 31;
          const CellIndex cell{at % 9 - 1, at / 5 % 11, at / 7 % 7 - 1};  // ghosts, too
          const CellDeposit given{n, -n, 1, n * n, cell.i - 50, 3 * n};
          cache.at(cell) += given;
          one_by_one.add(cell.linear(grid), given);
        }
      });
  const auto kept = host_copy(deposits.sum);
  const auto plain = host_copy(one_by_one.sum);
  std::int64_t size = 0;
  for (int cell = 0; cell < cells; ++cell) {
    for (int q = 0; q < Deposits::kQuantities; ++q) {
      EXPECT_EQ(kept(cell, q), plain(cell, q));
      size += std::abs(plain(cell, q));
    }
  }
  EXPECT_GT(size, 0);
}

}  // namespace
}  // namespace barchan
