// The flow looks at fractions and exchange in the surroundings of grains alone.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/fluid/field_algebra.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_run.hpp"

namespace barchan {
namespace {

/// A mound of mixture in a sheared flow, with clear fluid elsewhere. With kernels near the mound
/// alone, the flow is the same, and nothing is read elsewhere.
TEST(FlowNearGrains, IsTheSameWhereOnlyTheSurroundingsOfGrainsAreLookedAt) {
  Config config = test::flow_config({40, 12, 9}, {0.04, 0.012, 0.009}, 5e-4);
  config.grains.emplace();
  config.fluid->mean_velocity = 0.2;
  config.solver.pressure_tolerance = 1e-13;
  test::FlowRun whole(config), near(config);
  const auto is_in_mound = [](int i, int j, int k) {
    return i >= 12 && i < 16 && k >= 3 && k < 6 && j < 3;
  };
  const ColumnMarks marks("test: marks", near.grid, 1);
  for (int column = 0; column < 40 * 9; ++column)
    marks.on_host(0, column) = is_in_mound(column % 40, 0, column / 40);
  marks.on_host(0, 40 * 9) = 3;
  Kokkos::deep_copy(marks.on_device, marks.on_host);
  const ColumnMap mound = ColumnMap::marked(near.grid, marks, 0);
  FlowRegions regions(near.grid);
  regions.exchange.set(mound.dilated(1)), regions.fraction.set(mound.dilated(5));
  for (test::FlowRun* run : {&whole, &near}) {
    test::set_random(run->fluid.u.y, run->grid, 3);
    for_each_cell("test", run->grid, Axpby{0, run->fluid.u.y, 0.01, run->fluid.u.y});
    for (Field* alpha : {&run->fluid.alpha_f, &run->fluid.alpha_f_previous})
      test::set_field(*alpha, run->grid,
                      [&](int i, int j, int k) { return is_in_mound(i, j, k) ? 0.5 : 1; });
    run->start([&](int, int j, int k) { return 0.2 + 0.01 * j + 0.003 * k; });
  }
  const auto exchange_with = [&](const Grid& grid, double elsewhere) {
    ExchangeOnFaces exchange{make_faces("test", grid)};
    exchange.interlayer_drag_x = Field("test: interlayer drag", grid);
    exchange.interlayer_drag_z = Field("test: interlayer drag", grid);
    exchange.alpha_raw = Field("test: share", grid);
    const auto inside = [&](double value, double around) {
      return [=, &mound](int i, int j, int k) {
        return is_in_mound(i, j, k)                  ? value
               : mound.dilated(1).has(i, k) && j < 4 ? around
                                                     : elsewhere;
      };
    };
    for (Field* f : {&exchange.impulse.x, &exchange.impulse.y, &exchange.impulse.z})
      test::set_field(*f, grid, inside(-0.4, 0));
    for (Field* f : {&exchange.interlayer_drag_x, &exchange.interlayer_drag_z})
      test::set_field(*f, grid, inside(50, 0));
    const ColumnMap share_known = mound.dilated(6);
    test::set_everywhere(exchange.alpha_raw, grid, [&](int i, int j, int k) {
      const bool known = i >= 0 && i < 40 && share_known.has(i, (k + 9) % 9) && j < 9;
      return is_in_mound(i, j, k) ? 0.5 : known || elsewhere == 0 ? 1 : elsewhere;
    });
    return exchange;
  };
  const ExchangeOnFaces known = exchange_with(whole.grid, 0);
  ExchangeOnFaces looked_at = exchange_with(near.grid, std::nan(""));
  looked_at.regions = &regions;
  for (int step = 0; step < 3; ++step) {
    whole.advance(1e-4, &known);
    near.advance(1e-4, &looked_at);
    EXPECT_LE(near.report.pressure_residual, 1e-13);
    EXPECT_LE(near.report.continuity_residual, 1e-12);
  }
  EXPECT_NEAR(near.report.bulk_velocity.x, whole.report.bulk_velocity.x, 1e-14);
  for (const auto& [a, b] :
       {std::pair{whole.fluid.u.x, near.fluid.u.x}, std::pair{whole.fluid.u.y, near.fluid.u.y},
        std::pair{whole.fluid.u.z, near.fluid.u.z}}) {
    const auto of_whole = test::to_host(a), of_near = test::to_host(b);
    test::for_owned_cells(near.grid, [&](int i, int j, int k) {
      ASSERT_NEAR(of_near(i, j, k), of_whole(i, j, k), 1e-12) << i << " " << j << " " << k;
    });
  }
  const auto p = test::to_host(whole.fluid.p), q = test::to_host(near.fluid.p);
  test::for_owned_cells(near.grid, [&](int i, int j, int k) {
    ASSERT_NEAR(q(i, j, k), p(i, j, k), 1e-8) << i << " " << j << " " << k;
  });
}

}  // namespace
}  // namespace barchan
