// A flow from another mesh of the same box.
#include "src/initial/map_flow.hpp"

#include <gtest/gtest.h>

#include "kernels/fluid/conjugate_gradients.hpp"
#include "src/initial/initial_flow.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_run.hpp"

namespace barchan {
namespace {

using test::FlowRun;

Config mesh(std::array<int, 3> cells, double first) {
  Config config = test::flow_config(cells, {0.1, 0.025, 0.05}, first);
  config.fluid->mean_velocity = 0.28;
  return config;
}

double divergence(const FlowRun& run) {
  Field rest("rest", run.grid);
  return max_each_cell("test", run.grid,
                       ContinuityResidual<Fraction::variable>{{.grid = run.grid,
                                                               .u = run.fluid.u,
                                                               .alpha = run.fluid.alpha_f,
                                                               .alpha_before = run.fluid.alpha_f,
                                                               .c = run.fluid.u,
                                                               .drive_dt = 0,
                                                               .density = 1,
                                                               .dt = 1,
                                                               .b = rest}});
}

double largest_difference(const Field& a, const Field& b, const Grid& grid) {
  const auto host_a = test::to_host(a), host_b = test::to_host(b);
  double largest = 0;
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    largest = std::max(largest, std::abs(host_a(i, j, k) - host_b(i, j, k)));
  });
  return largest;
}

TEST(MapFlow, ShearBetweenALidAndTheFloorIsExactOnEveryMesh) {
  const auto moving_lid = [](std::array<int, 3> cells, double first) {
    Config config = mesh(cells, first);
    config.fluid->top = WallFlow::no_slip;
    config.fluid->top_velocity = 0.5;
    return config;
  };
  FlowRun coarse(moving_lid({9, 8, 6}, 2e-3)), fine(moving_lid({16, 21, 11}, 3e-4));
  coarse.config.grains = fine.config.grains = GrainConfig{};
  const auto rising = [&](double factor) {
    return [&, factor](int, int j, int) { return 0.4 + factor * coarse.h.y(j); };
  };
  test::set_field(coarse.fluid.p, coarse.grid, rising(3));
  test::set_field(coarse.fluid.nu_t, coarse.grid, rising(5));
  test::set_field(coarse.fluid.du_dt.z, coarse.grid, rising(7));
  test::set_field(coarse.fluid.alpha_f, coarse.grid, rising(9));
  coarse.start([&](int, int j, int) { return 20 * coarse.h.y(j); });
  map_flow(fine.config, coarse.fluid, fine.fluid);
  const auto u = test::to_host(fine.fluid.u.x), p = test::to_host(fine.fluid.p),
             nu_t = test::to_host(fine.fluid.nu_t), rate = test::to_host(fine.fluid.du_dt.z),
             alpha = test::to_host(fine.fluid.alpha_f);
  // The bulk velocity of a sheared mixture is a sum over its rows, and kept: the shear is not
  // quite.
  const double scale = u(3, 10, 4) / (20 * fine.h.y(10));
  EXPECT_NEAR(scale, 1, 0.02);
  EXPECT_NEAR(bulk_velocity(fine.fluid), bulk_velocity(coarse.fluid), 1e-14);
  for (int j = 0; j < 21; ++j) {
    const double y = fine.h.y(j);
    EXPECT_NEAR(u(3, j, 4), scale * 20 * y, 1e-12) << "row " << j;
    if (y < coarse.h.y(0) || y > coarse.h.y(7)) continue;  // walls without a gradient
    EXPECT_NEAR(p(3, j, 4), 0.4 + 3 * y, 1e-14) << "row " << j;
    EXPECT_NEAR(rate(3, j, 4), 0.4 + 7 * y, 1e-14) << "row " << j;
    EXPECT_NEAR(nu_t(3, j, 4), 0.4 + 5 * y, 1e-14) << "row " << j;
    EXPECT_NEAR(alpha(3, j, 4), 0.4 + 9 * y, 1e-14) << "row " << j;
  }
}

TEST(MapFlow, TurbulentFlowKeepsItsBulkVelocityAndHasNoDivergence) {
  FlowRun from(mesh({24, 16, 18}, 5e-4));
  set_flow(TurbulentFlow{}, from.config, from.fluid);
  for (const auto& [cells, first] :
       {std::pair{std::array{36, 30, 20}, 2e-4}, std::pair{std::array{16, 11, 24}, 1e-3}}) {
    FlowRun to(mesh(cells, first));
    map_flow(to.config, from.fluid, to.fluid);
    to.solver.fill_ghosts(to.fluid);
    EXPECT_NEAR(bulk_velocity(to.fluid), bulk_velocity(from.fluid), 1e-14);
    EXPECT_LT(divergence(to), 1e-11);
    // The smallest eddies lose something between nodes, the mean flow nothing.
    EXPECT_NEAR(to.solver.kinetic_energy(to.fluid) / from.solver.kinetic_energy(from.fluid), 1,
                0.01);
  }
}

TEST(MapFlow, AWindowHasTheFlowOfItsPlace) {
  FlowRun from(mesh({20, 8, 10}, 2e-3));
  // A row of points repeats after 0.05 m across; from 0.0125 to 0.0375 m it is linear.
  const auto at = [](double y, double z) { return 20 * y + 7 * z; };
  test::set_field(from.fluid.alpha_f, from.grid, [](int, int, int) { return 1.0; });
  from.start([&](int, int j, int k) { return at(from.h.y(j), (k + 0.5) * 0.005); });
  Config part = test::flow_config({16, 12, 10}, {0.03, 0.012, 0.02}, 0);
  part.fluid->top = WallFlow::no_slip;
  FlowRun to(part);
  map_window(to.config, *from.config.fluid, {0.04, 0.015}, from.fluid, to.fluid);
  const auto u = test::to_host(to.fluid.u.x), across = test::to_host(to.fluid.u.z);
  for (int k = 0; k < 10; ++k)
    for (int j = 1; j < 12; ++j) {  // the lowest lies between a wall and a node
      const double y = to.h.y(j), z = 0.015 + (k + 0.5) * 0.002;
      if (y < from.h.y(0)) continue;
      EXPECT_NEAR(u(3, j, k), at(y, z), 1e-12) << "row " << j << ", " << k;
      EXPECT_NEAR(across(3, j, k), 0, 1e-12);
    }
}

TEST(MapFlow, AFlowAcrossKeepsItsBulkVelocity) {
  Config coarse = mesh({24, 16, 18}, 5e-4), fine = mesh({36, 30, 20}, 2e-4);
  coarse.fluid->mean_velocity = fine.fluid->mean_velocity = {0, -0.28};
  FlowRun from(coarse), to(fine);
  set_flow(TurbulentFlow{}, coarse, from.fluid);
  map_flow(fine, from.fluid, to.fluid);
  EXPECT_NEAR(bulk_velocity_across(from.fluid), -0.28, 1e-14);
  EXPECT_NEAR(bulk_velocity_across(to.fluid), -0.28, 1e-14);
  EXPECT_NEAR(bulk_velocity(to.fluid), 0, 1e-4) << "that of the interpolation";
}

TEST(MapFlow, OnTheSameMeshNothingChanges) {
  FlowRun from(mesh({24, 16, 18}, 5e-4)), to(from.config);
  set_flow(TurbulentFlow{}, from.config, from.fluid);
  from.solver.fill_ghosts(from.fluid);
  map_flow(to.config, from.fluid, to.fluid);
  EXPECT_LT(largest_difference(from.fluid.u.x, to.fluid.u.x, from.grid), 1e-13);
  EXPECT_LT(largest_difference(from.fluid.u.z, to.fluid.u.z, from.grid), 1e-13);
}

TEST(MapFlow, BetweenGrainsTheFlowOfTheMixtureHasNoDivergence) {
  Config coarse = mesh({24, 16, 18}, 5e-4), fine = mesh({36, 30, 20}, 2e-4);
  coarse.grains = fine.grains = GrainConfig{};
  FlowRun from(coarse), to(fine);
  set_flow(TurbulentFlow{}, coarse, from.fluid);
  const auto heap = [&](int i, int j, int k) {
    return i > 8 && i < 14 && j < 5 && k > 6 && k < 12 ? 0.45 : 1.0;
  };
  test::set_field(from.fluid.alpha_f, from.grid, heap);
  test::set_field(from.fluid.alpha_f_previous, from.grid, heap);
  map_flow(fine, from.fluid, to.fluid);
  to.solver.fill_ghosts(to.fluid);
  EXPECT_NEAR(bulk_velocity(to.fluid), bulk_velocity(from.fluid), 1e-14);
  EXPECT_LT(divergence(to), 1e-4);  // 1/s; the heap's edges alone make 200 of it on the coarse mesh
}

}  // namespace
}  // namespace barchan
