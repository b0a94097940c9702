// The columns of cells near grains, loops over them, and the smoothing there.
#include "src/parallel/region.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <vector>

#include "kernels/fluid/flow_sums.hpp"
#include "src/coupling/smoother.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

using Column = std::pair<int, int>;  // i, k

Grid grid_of(std::array<int, 3> n) {
  return test::stretched_grid(n, {n[0] * 1e-3, 0.01, n[2] * 1e-3}, 0.5 * 0.01 / n[1]);
}

/// Map of these columns up to the rows [0, top).
ColumnMap map_of(const Grid& grid, const std::vector<Column>& columns, int top) {
  const ColumnMarks marks("test: marks", grid, 1);
  for (const auto& [i, k] : columns) marks.on_host(0, i + grid.nx * k) = 1;
  marks.on_host(0, grid.nx * grid.nz) = top;
  Kokkos::deep_copy(marks.on_device, marks.on_host);
  return ColumnMap::marked(grid, marks, 0);
}

std::set<Column> columns_of(const Grid& grid, const ColumnMap& map) {
  std::set<Column> found;
  for (int k = 0; k < grid.nz; ++k) {
    for (int i = 0; i < grid.nx; ++i)
      if (map.has(i, k)) found.insert({i, k});
  }
  return found;
}

TEST(ColumnMap, GrowsAcrossThePeriodicEnds) {
  const Grid grid = grid_of({9, 5, 7});
  const ColumnMap map = map_of(grid, {{0, 6}, {4, 3}}, 4).dilated(1);
  const std::set<Column> expected{{8, 5}, {0, 5}, {1, 5}, {8, 6}, {0, 6}, {1, 6},
                                  {8, 0}, {0, 0}, {1, 0}, {3, 2}, {4, 2}, {5, 2},
                                  {3, 3}, {4, 3}, {5, 3}, {3, 4}, {4, 4}, {5, 4}};
  EXPECT_EQ(columns_of(grid, map), expected);
  EXPECT_EQ(map.top(), 5);
  EXPECT_EQ(map.dilated(9).top(), 5);
  EXPECT_EQ(columns_of(grid, map.dilated(9)).size(), 63u);
  EXPECT_TRUE(ColumnMap().dilated(3).is_empty());
}

TEST(ColumnMap, BlocksAndUnions) {
  const Grid grid = grid_of({11, 5, 3});
  const ColumnMap map = map_of(grid, {{5, 0}, {9, 2}}, 2);
  const std::set<Column> blocks{{4, 0}, {5, 0}, {6, 0}, {7, 0}, {8, 2}, {9, 2}, {10, 2}};
  EXPECT_EQ(columns_of(grid, map.padded_to_blocks(4)), blocks);
  const ColumnMap both = map.united(map_of(grid, {{1, 1}}, 3));
  EXPECT_EQ(columns_of(grid, both), (std::set<Column>{{5, 0}, {9, 2}, {1, 1}}));
  EXPECT_EQ(both.top(), 3);
}

TEST(ColumnMap, BoundsHoldEveryColumn) {
  const Grid grid = grid_of({11, 5, 9});
  const CellRange bounds = map_of(grid, {{5, 7}, {9, 2}}, 2).bounds();
  const std::array<int, 6> found{bounds.i0, bounds.i1, bounds.j0, bounds.j1, bounds.k0, bounds.k1};
  EXPECT_EQ(found, (std::array<int, 6>{5, 10, 0, 2, 2, 8}));
}

TEST(ColumnMap, StretchesOfXMayGoAcrossTheEnd) {
  const Grid grid = grid_of({20, 5, 3});
  const auto stretches =
      map_of(grid, {{1, 0}, {7, 1}, {8, 2}, {10, 0}, {19, 2}}, 2).stretches_of_x(2);
  ASSERT_EQ(stretches.size(), 2u);
  EXPECT_EQ(stretches[0].first, 7);
  EXPECT_EQ(stretches[0].last, 11);
  EXPECT_EQ(stretches[1].first, 19);
  EXPECT_EQ(stretches[1].last, 22);
}

TEST(ColumnMap, FindsWhereAFieldIsNotOne) {
  const Grid grid = grid_of({6, 5, 4});
  Field f("f", grid);
  test::set_field(f, grid, [](int i, int j, int k) {
    return (i == 2 && j == 3 && k == 1) || (i == 5 && j == 0 && k == 3) ? 1 - 1e-15 : 1.0;
  });
  const ColumnMarks marks("test: marks", grid, 2);
  Region where(grid);
  const auto not_one = [&] {
    marks.set_zero();
    mark_not_one(marks, 1, grid, f, where);
    marks.fetch();
    EXPECT_TRUE(ColumnMap::marked(grid, marks, 0).is_empty());
    return ColumnMap::marked(grid, marks, 1);
  };
  const ColumnMap map = not_one();
  EXPECT_EQ(columns_of(grid, map), (std::set<Column>{{2, 1}, {5, 3}}));
  EXPECT_EQ(map.top(), 4);
  where.set(map_of(grid, {{4, 3}, {5, 3}}, 2));  // elsewhere it is not looked at
  EXPECT_EQ(columns_of(grid, not_one()), (std::set<Column>{{5, 3}}));
  EXPECT_EQ(not_one().top(), 1);
  test::set_field(f, grid, [](int, int, int) { return 1.0; });
  EXPECT_TRUE(not_one().is_empty());
}

/// Adds a number to a cell, and returns it.
struct Add {
  FieldRef f;
  Real number;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    f(i, j, k) += number;
    return number;
  }
};

TEST(Region, EveryCellIsVisitedOnceByTheFunctorOfItsPart) {
  const Grid grid = grid_of({13, 4, 5});
  const ColumnMap inner = map_of(grid, {{3, 1}, {4, 1}, {12, 1}, {0, 2}, {7, 2}}, 2);
  const ColumnMap outer = inner.dilated(1);
  Region in(grid), out(grid);
  in.set(inner), out.set(outer);
  Field f("f", grid);
  const DeviceReductions reductions("test", 2);
  const auto sum_over = [&](const auto& cells, const auto& functor) {
    sum_each_cell("test", reductions, 1, cells, functor);
    reductions.fetch();
    return reductions.get(1);
  };
  const Real sum =
      sum_over(owned_cells(grid),
               ByRegion{in.ref(), Add{f, 100}, ByRegion{out.ref(), Add{f, 10}, Add{f, 1}}});
  const Real sum_inside = sum_over(in, Add{f, 1000});
  const auto got = test::to_host(f);
  Real expected_sum = 0, expected_inside = 0;
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    const bool is_in = inner.has(i, k) && j < inner.top();
    const bool is_out = outer.has(i, k) && j < outer.top();
    const Real once = is_in ? 100 : is_out ? 10 : 1;
    EXPECT_EQ(got(i, j, k), once + (is_in ? 1000 : 0)) << i << " " << j << " " << k;
    expected_sum += once;
    expected_inside += is_in ? 1000 : 0;
  });
  EXPECT_EQ(sum, expected_sum);
  EXPECT_EQ(sum_inside, expected_inside);
  in.set({});
  EXPECT_EQ(sum_over(in, Add{f, 1000}), 0);
  EXPECT_FALSE(in.has_ghosts());
}

/// Compares the solution in the region of grains with that over all columns.
void compare_with_everywhere(const Grid& grid, const std::vector<Column>& grains) {
  const Real length = 4e-4;
  const auto fft = std::make_shared<const PlaneFft>(grid);
  const Smoother smoother(grid, fft, {}, length);
  const PoissonFft everywhere(grid, fft, 1, length * length);
  EXPECT_GT(smoother.reach(), 5);
  const ColumnMap held = map_of(grid, grains, 3);
  ColumnMap columns = held.dilated(smoother.reach());
  columns.set_top(smoother.top_above(held.top()));
  Region region(grid);
  region.set(columns);
  Field f("f", grid), g("g", grid);
  const auto solid = [&](int i, int j, int k) {
    return held.has(i, k) && j < 3 ? 0.3 + 0.1 * j : 0.0;
  };
  test::set_field(g, grid, solid);
  everywhere.solve(g, g);
  test::set_field(f, grid, [&](int i, int j, int k) {  // elsewhere it is not looked at
    return columns.has(i, k) && j < columns.top() ? solid(i, j, k) : 1e9;
  });
  smoother.solve(f, region);
  const auto near = test::to_host(f), all = test::to_host(g);
  Real beyond = 0;
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    if (columns.has(i, k) && j < columns.top()) {
      EXPECT_NEAR(near(i, j, k), all(i, j, k), 1e-12);
    } else {
      beyond = std::max(beyond, std::abs(all(i, j, k)));
    }
  });
  EXPECT_LT(beyond, Smoother::kTolerance);
}

/// Solution as over all columns: in the middle, across the periodic end, in two stretches, each
/// where one direction is short and where none is.
TEST(Smoother, WhereGrainsAreIsAsGoodAsEverywhere) {
  for (const std::vector<Column>& grains :
       {std::vector<Column>{{44, 3}, {46, 7}}, {{1, 2}}, {{20, 0}, {62, 9}}}) {
    compare_with_everywhere(grid_of({90, 12, 10}), grains);
    std::vector<Column> turned;
    for (const auto& [i, k] : grains) turned.push_back({k, i});
    compare_with_everywhere(grid_of({10, 12, 90}), turned);
  }
  for (const std::vector<Column>& grains :
       {std::vector<Column>{{44, 33}, {46, 37}}, {{1, 78}}, {{20, 15}, {62, 58}}})
    compare_with_everywhere(grid_of({90, 12, 80}), grains);
}

/// A map of columns that has none: the last grain has left.
TEST(Smoother, WithoutColumnsNothingIsSolved) {
  const Grid grid = grid_of({90, 12, 80});
  const Smoother smoother(grid, std::make_shared<const PlaneFft>(grid), {}, 4e-4);
  Region region(grid);
  region.set(map_of(grid, {}, 5));  // rows that smoothing would reach
  Field f("f", grid);
  test::set_field(f, grid, [](int, int, int) { return 1.0; });
  smoother.solve(f, region);
  const auto after = test::to_host(f);
  test::for_owned_cells(grid, [&](int i, int j, int k) { ASSERT_EQ(after(i, j, k), 1); });
}

TEST(Smoother, WithoutALengthNothingSpreads) {
  const Grid grid = grid_of({12, 4, 5});
  const Smoother smoother(grid, std::make_shared<const PlaneFft>(grid), {}, 0);
  EXPECT_EQ(smoother.reach(), 0);
  EXPECT_EQ(smoother.top_above(2), 2);
}

}  // namespace
}  // namespace barchan
