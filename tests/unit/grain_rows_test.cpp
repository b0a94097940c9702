// Rows of cells that hold a height, or a grain; sums over the cells of grains.
#include "kernels/coupling/grain_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

/// Integrals of the cross-section of a unit sphere over its volume, and of height times this,
/// between two heights. Simpson's rule is exact for them.
struct Slice {
  Real share, moment;
  Slice(Real a, Real b) {
    a = std::clamp(a, Real(-1), Real(1)), b = std::clamp(b, Real(-1), Real(1));
    const auto simpson = [&](const auto& f) {
      return (b - a) / 6 * (f(a) + 4 * f((a + b) / 2) + f(b));
    };
    share = simpson([](Real z) { return 0.75 * (1 - z * z); });
    moment = simpson([](Real z) { return 0.75 * (1 - z * z) * z; });
  }
};

// Grains smaller and larger than a row, inside and across the floor and the lid.
TEST(Rows, AGrainHasInEachRowItsPartOfTheSphere) {
  const Real infinity = std::numeric_limits<Real>::infinity();
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<Real> height(-1e-4, 0.0041), radius(2e-5, 4e-4);
  int of_two_rows = 0, of_many = 0;
  for (const test::HostGrid& host : grids()) {
    const GridRef grid = host.ref();
    for (int n = 0; n < 600; ++n) {
      const Real y = height(generator), r = radius(generator);
      const GrainRows rows(grid, y, r);
      of_two_rows += rows.n == 2 ? 1 : 0, of_many += rows.n > 3 ? 1 : 0;
      EXPECT_EQ(rows.row[0], grid.row_of(y));
      Real sum = 0, mean = 0;
      for (int q = 0; q < rows.n; ++q) {
        const int j = rows.row[q];
        const Slice part(j == 0 ? -infinity : (grid.y_face(j) - y) / r,
                         j == grid.ny - 1 ? infinity : (grid.y_face(j + 1) - y) / r);
        EXPECT_NEAR(rows.weight(q), part.share, 2e-6);
        EXPECT_NEAR(rows.weight(q) * (rows.height(grid, q) - y) / r, part.moment, 2e-6);
        const Real above_middle = rows.height(grid, q) - grid.y_centre(j);
        EXPECT_NEAR(rows.over_upper[q] * (grid.y_centre(j + 1) - grid.y_centre(j)), above_middle,
                    1e-15);
        EXPECT_EQ(rows.find(j), q);
        sum += rows.weight(q), mean += rows.weight(q) * rows.height(grid, q);
      }
      EXPECT_NEAR(sum, 1, 1e-15);
      EXPECT_NEAR(mean, y, 1e-15);
    }
  }
  EXPECT_GT(of_two_rows, 100);
  EXPECT_GT(of_many, 10);
}

TEST(Rows, EachPointIsInTheRowThatHoldsIt) {
  std::mt19937_64 generator(4);
  std::uniform_real_distribution<Real> height(-1e-4, 0.0041), radius(2e-5, 4e-4);
  for (const test::HostGrid& host : grids()) {
    const GridRef grid = host.ref();
    for (int n = 0; n < 300; ++n) {
      const Real y = height(generator), r = radius(generator);
      const GrainRows rows(grid, y, r);
      PointSet all = 0, outside = 0;
      for (int p = 0; p < kDividedPoints; ++p) {
        const Real at = y + r * divided_point(p).y;
        if (at < 0 || at > grid.ly) outside |= PointSet{1} << p;
        ASSERT_TRUE(rows.points[rows.find(grid.row_of(at))] >> p & 1) << p << " at " << at;
      }
      EXPECT_EQ(rows.outside, outside);
      for (int q = 0; q < rows.n; ++q) {
        EXPECT_EQ(all & rows.points[q], 0u);
        all |= rows.points[q];
      }
      EXPECT_EQ(all, kAllPoints);
    }
  }
}

// Grains that lie on a floor rise and sink together: what they carry across a face must be their
// volume, at any height of the rows.
TEST(Rows, APartOfAGrainMovesWithTheGrain) {
  const Real r = 1e-4, step = 1e-3 * r;
  for (const test::HostGrid& host : grids()) {
    const GridRef grid = host.ref();
    for (Real y = r; y < 0.003; y += step) {
      const GrainRows before(grid, y, r), after(grid, y + step, r);
      for (int j = 0; j < grid.ny; ++j) {
        const auto part = [j](const GrainRows& rows) {
          const int q = rows.find(j);
          return rows.row[q] == j ? rows.weight(q) : Real(0);
        };
        // At most through the middle of the sphere: 3/4 of its volume a radius.
        EXPECT_LE(std::abs(part(after) - part(before)), 0.75 * step / r + 4e-6) << y << " " << j;
      }
    }
  }
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
