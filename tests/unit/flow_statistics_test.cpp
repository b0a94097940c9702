// Turbulence statistics against fields whose means are known.
#include <gtest/gtest.h>

#include <numbers>

#include "src/diagnostics/flow_statistics.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/run/run_folder.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

using std::numbers::pi;

struct WavyShear {
  Config config = test::flow_config({16, 10, 12}, {0.04, 0.02, 0.03}, 1e-3);
  Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid);
  FlowStatistics statistics{*config.fluid, grid};

  /// u = 8 y + a wave, v a wave in phase with it: <u'v'> = -a b / 2 where both are away from walls.
  void set(double a, double b) {
    const test::HostGrid h(grid);
    const double k = 2 * pi / 0.04;
    test::set_field(fluid.u.x, grid,
                    [&](int i, int j, int) { return 8 * h.y(j) + a * std::cos(k * h.x_face(i)); });
    test::set_field(fluid.u.y, grid,
                    [&](int i, int j, int) { return j > 0 ? -b * std::cos(k * h.x(i)) : 0.0; });
    FluidSolver(config, grid).fill_ghosts(fluid);
  }
};

TEST(FlowStatistics, MeansAndStressesOfAWavyShear) {
  WavyShear flow;
  const double a = 0.02, b = 0.01;
  flow.set(a, b);
  flow.statistics.sample(flow.fluid);
  flow.statistics.sample(flow.fluid);
  const FlowStatisticsTable table = flow.statistics.table();
  const test::HostGrid h(flow.grid);
  EXPECT_EQ(table.n_samples, 2);
  EXPECT_NEAR(table.u_star, std::sqrt(1e-6 * 8), 1e-12);
  // u and v meet at the edges: the mean of two neighbours of a cosine is less than the cosine.
  const double averaging = std::cos(pi / 16);
  for (int j = 2; j < 8; ++j) {
    const StatisticsRow& row = table.rows[static_cast<std::size_t>(j)];
    EXPECT_NEAR(row.y, h.y(j), 1e-15);
    EXPECT_NEAR(row.u, 8 * h.y(j), 1e-14);
    EXPECT_NEAR(row.uu, a * a / 2, 1e-14);
    EXPECT_NEAR(row.vv, b * b / 2, 1e-14);
    EXPECT_NEAR(row.ww, 0, 1e-15);
    EXPECT_NEAR(row.uv, -a * b / 2 * averaging, 1e-12);
    EXPECT_NEAR(row.viscous, 8e-6, 1e-15);
    EXPECT_NEAR(row.subgrid, 0, 1e-15);
    EXPECT_NEAR(row.total, 8e-6 + a * b / 2 * averaging, 1e-12);
  }
}

TEST(FlowStatistics, FluctuationsAreAgainstTheMeanOfAllSamples) {
  WavyShear flow;
  for (const double speed : {0.1, 0.3}) {
    test::set_field(flow.fluid.u.x, flow.grid, [&](int, int, int) { return speed; });
    FluidSolver(flow.config, flow.grid).fill_ghosts(flow.fluid);
    flow.statistics.sample(flow.fluid);
  }
  const StatisticsRow row = flow.statistics.table().rows[5];
  EXPECT_NEAR(row.u, 0.2, 1e-14);
  EXPECT_NEAR(row.uu, 0.01, 1e-14);
}

TEST(FlowStatistics, SurviveARestart) {
  const TemporaryFolder folder;
  WavyShear flow;
  flow.set(0.03, 0.02);
  flow.statistics.sample(flow.fluid);
  std::filesystem::create_directories(folder / "run");
  CheckpointWriter writer(folder / "run", 7, make_provenance(flow.config));
  flow.statistics.save(writer);
  const auto file = writer.commit(1);
  FlowStatistics again(*flow.config.fluid, flow.grid);
  again.load(CheckpointReader(file));
  EXPECT_EQ(again.table().n_samples, 1);
  for (std::size_t j = 0; j < 10; ++j) {
    EXPECT_EQ(again.table().rows[j].uv, flow.statistics.table().rows[j].uv);
    EXPECT_EQ(again.table().rows[j].total, flow.statistics.table().rows[j].total);
  }
}

}  // namespace
}  // namespace barchan
