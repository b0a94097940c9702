// Turbulence statistics against fields whose means are known.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "src/diagnostics/flow_average.hpp"
#include "src/diagnostics/flow_statistics.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/run/run_folder.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using std::numbers::pi;

struct WavyShear {
  Config config = test::flow_config({16, 10, 12}, {0.04, 0.02, 0.03}, 1e-3);
  Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid);
  FlowStatistics statistics{*config.fluid, grid};

  /// u = 8 y + a wave, v a wave ahead of it: <u'v'> = -a b / 2 cos(ahead) away from the walls.
  double ahead = 0.5;
  void set(double a, double b) {
    test::set_faces(fluid.u, grid, [&](std::size_t axis, double x, double y, double) {
      const double phase = 2 * pi / 0.04 * x;
      return axis == 0 ? 8 * y + a * std::cos(phase) : axis == 1 ? -b * std::cos(phase + ahead) : 0;
    });
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
  EXPECT_NEAR(table.u_star, std::sqrt(1e-6 * 8), 1e-12);
  // u and v meet at the edges: the mean of two neighbours of a cosine is less than the cosine.
  const double averaging = std::cos(pi / 16) * std::cos(flow.ahead);
  for (int j = 2; j < 8; ++j) {
    const StatisticsRecord& row = table.lines[static_cast<std::size_t>(j)];
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
  const StatisticsRecord row = flow.statistics.table().lines[5];
  EXPECT_NEAR(row.u, 0.2, 1e-14);
  EXPECT_NEAR(row.uu, 0.01, 1e-14);
}

// --- Averages of the flow on the grid against a flow whose means and second moments are known.

constexpr int kSamples = 8;

/// A steady shear of 40 m/s with small swings in time: u' = a cos, v' = -b cos, w' = c sin.
struct SwingingFlow {
  Config config = test::flow_config({6, 5, 4}, {0.04, 0.02, 0.03}, 1e-3);
  Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid);
  double a = 0.02, b = 0.01, c = 0.03;

  void set(int sample) {
    const double phase = 2 * pi * (sample + 0.3) / kSamples;
    test::set_faces(fluid.u, grid, [&](std::size_t axis, double, double y, double) {
      if (axis == 0) return 40 + 8 * y + a * std::cos(phase);
      return axis == 1 ? -b * std::cos(phase) : c * std::sin(phase);
    });
    test::set_field(fluid.p, grid, [&](int i, int, int) { return 1.0 * i + sample; });
    FluidSolver(config, grid).fill_ghosts(fluid);
  }
};

double at(const std::vector<NamedField>& fields, const std::string& name, int i, int j, int k) {
  for (const NamedField& field : fields) {
    if (field.name == name) return test::to_host(*field.field)(i, j, k);
  }
  return NAN;
}

TEST(FlowAverage, MeansAndSecondMomentsOfASwingingFlow) {
  SwingingFlow flow;
  FlowAverage average(flow.grid);
  EXPECT_TRUE(average.means().empty());
  for (int n = 0; n < kSamples; ++n) {
    flow.set(n);
    average.sample(flow.fluid, 1 + 0.1 * n);
  }
  const std::vector<NamedField> means = average.means();
  ASSERT_EQ(means.size(), 12u);
  const int i = 2, j = 2, k = 1;  // away from the walls
  const std::map<std::string, double> known = {{"u", 40 + 8 * test::HostGrid(flow.grid).y(j)},
                                               {"v", 0},
                                               {"w", 0},
                                               {"p", i + (kSamples - 1) / 2.0},
                                               {"alpha_f", 1},
                                               {"nu_t", 0},
                                               {"uu", flow.a * flow.a / 2},
                                               {"vv", flow.b * flow.b / 2},
                                               {"ww", flow.c * flow.c / 2},
                                               {"uv", -flow.a * flow.b / 2},
                                               {"uw", 0},
                                               {"vw", 0}};
  for (const auto& [name, value] : known) {
    EXPECT_NEAR(at(means, name, i, j, k), value, value > 1 ? 1e-13 : 1e-15) << name;
  }
  // v' is half as large in the first row as above: the floor stands still.
  EXPECT_NEAR(at(means, "uv", i, 0, k), -flow.a * flow.b / 4, 1e-15);
}

TEST(FlowAverage, FileHoldsOneFrameWithItsWindow) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "run");
  SwingingFlow flow;
  FlowAverage average(flow.grid);
  const OutputFiles output(folder / "run", make_provenance(flow.config));
  for (int n = 0; n < 2; ++n) {
    flow.set(n);
    average.sample(flow.fluid, 1 + 0.1 * n);
    average.write(output, 1 + 0.1 * n, 10 + n);  // the second one replaces the first
  }
  const Hdf5File file(folder / "run" / "flow_average.h5", Hdf5File::Mode::read);
  EXPECT_EQ(list_frames(file).size(), 1u);
  EXPECT_DOUBLE_EQ(file.attribute<double>("frame_000000", "window_start"), 1);
  EXPECT_DOUBLE_EQ(file.attribute<double>("frame_000000", "time"), 1.1);
  EXPECT_DOUBLE_EQ(file.attribute<double>("frame_000000", "n_samples"), 2);
  EXPECT_TRUE(file.exists("frame_000000/uv"));
  EXPECT_TRUE(file.exists("grid/y_face"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run" / "flow_average.xdmf"));
}

}  // namespace
}  // namespace barchan
