// Probes on any number of ranks.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "src/diagnostics/probes.hpp"
#include "tests/support/shared_grid.hpp"

namespace barchan {
namespace {

/// Nonlinear flow, so that a point read in the wrong cell shows. It depends on the indices among
/// all cells, so that nodes have the same bits on any number of ranks.
FluidState flow_on(const Grid& grid) {
  FluidState fluid = make_fluid_state(grid);
  double phase = 0;
  for (const Field& f : {fluid.u.x, fluid.u.y, fluid.u.z, fluid.p}) {
    test::set_everywhere(f, grid, [&](int i, int j, int k) {
      return std::sin(0.7 * (i + grid.i_begin) + phase) * std::cos(0.5 * (k + grid.k_begin)) + j;
    });
    phase += 1;
  }
  return fluid;
}

TEST(ProbesOverRanks, HaveTheBitsOfOneRank) {
  const std::array<double, 3> size{0.04, 0.02, 0.03};
  const test::SharedGrid grids({16, 6, 12}, size, 1e-3);
  Config config = test::flow_config({16, 6, 12}, size, 1e-3);
  // Probes on every cut there may be, and on the edges of the box.
  config.output.probes = {
      {.name = "along", .from = {{0, 0.004, 0.011}}, .to = {{0.04, 0.004, 0.011}}, .points = 33},
      {.name = "across", .from = {{0.013, 0, 0}}, .to = {{0.013, 0.02, 0.03}}, .points = 49},
      {.name = "corner", .at = {{0.04, 0.02, 0.03}}}};
  const FluidState whole = flow_on(grids.whole), mine = flow_on(grids.mine);
  Probes on_one(config), on_all(config);
  for (std::size_t n = 0; n < on_one.count(); ++n) {
    const auto a = on_one.sample(n, whole, 0), b = on_all.sample(n, mine, 0);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].u, b[i].u) << n << " " << i;
      EXPECT_EQ(a[i].v, b[i].v) << n << " " << i;
      EXPECT_EQ(a[i].w, b[i].w) << n << " " << i;
      EXPECT_EQ(a[i].p, b[i].p) << n << " " << i;
      EXPECT_EQ(a[i].wall_shear_x, b[i].wall_shear_x) << n << " " << i;
      EXPECT_EQ(a[i].wall_shear_z, b[i].wall_shear_z) << n << " " << i;
    }
  }
  EXPECT_NE(on_all.sample(2, mine, 0)[0].u, 0);
}

}  // namespace
}  // namespace barchan
