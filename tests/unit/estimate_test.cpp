// Estimates of `check` before a case is run: its grains, its starts, and how long it will take.
#include "src/app/estimate.hpp"
#include "kernels/coupling/markers.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "kernels/coupling/markers.hpp"
#include "src/app/check_case.hpp"
#include "src/app/memory.hpp"
#include "src/base/errors.hpp"
#include "src/case/heaps.hpp"
#include "src/case/load.hpp"
#include "src/initial/pour.hpp"
#include "src/run/simulation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

const std::vector<SizeClass> kSizes = {{1.5e-4, 50}, {2e-4, 900}, {2.5e-4, 50}};

/// A thousand grains in a channel; 1000 fluid steps of 50 grain steps.
Config dune() {
  Config c;
  c.time = {.end = 0.5, .fluid_step = 5e-4, .grain_step = 1e-5};
  c.size = {0.04, 0.02, 0.02};
  c.fluid = FluidConfig{.cells = {40, 20, 20}, .mean_velocity = 0.2};
  c.grains = GrainConfig{};
  c.output = {
      .history_interval = 0, .dune_interval = 0, .grains_interval = 0, .fields_interval = 0};
  return c;
}

TEST(Memory, GrowsWithCellsAndGrains) {
  Config c = dune();
  // 14 numbers of the state, 30 of work space and two complex transforms of 16,000 cells.
  EXPECT_DOUBLE_EQ(memory_of_case(c, {}), 8 * (14 + 30 + 4) * 16000.0);
  EXPECT_DOUBLE_EQ(memory_of_case(c, kSizes) - memory_of_case(c, {}), 1000 * 1000.0);
  EXPECT_EQ(memory_line(c, {}), "  memory                  about 6 MB\n");
}

/// 8 cells a diameter: 11 faces across a patch, 168 markers.
TEST(Memory, MarkersOfResolvedGrainsCount) {
  Config c = dune();
  const std::vector<SizeClass> grains{{.diameter = 8e-3, .count = 10}};
  const double without = memory_of_case(c, grains);
  c.coupling.scheme = CouplingScheme::resolved;
  const double markers = markers_on_sphere(4 - kRetraction);
  EXPECT_DOUBLE_EQ(memory_of_case(c, grains) - without,
                   10 * 8 * (3 * 11.0 * 11 * 11 + 6 * markers));
  c.grains->frozen = true;
  EXPECT_DOUBLE_EQ(memory_of_case(c, grains), without);
}

TEST(RunSeconds, CountEachPartAsOftenAsItIsDone) {
  Config c = dune();
  EXPECT_DOUBLE_EQ(run_seconds({c, kSizes}, {.flow = 2, .pressure = 1, .iterations = 4}).flow,
                   3000);
  EXPECT_DOUBLE_EQ(run_seconds({c, kSizes}, {.exchange = 3}).exchange, 3000);
  // A flow that moves the grains costs more than grains at rest, but not twice as much.
  const double moving = run_seconds({c, kSizes}, {.grain_step = 1}).grains;
  EXPECT_GT(moving, 50000);
  EXPECT_LT(moving, 100000);
  EXPECT_DOUBLE_EQ(run_seconds({c, kSizes}, {.rebuild = 2}).lists, rebuild_rate({c, kSizes}));
  c.grains->frozen = true;
  EXPECT_EQ(run_seconds({c, kSizes}, {.grain_step = 1, .rebuild = 2}).all(), 0);
  c.grains->frozen = false;
  c.fluid.reset();
  EXPECT_DOUBLE_EQ(run_seconds({c, kSizes}, {.grain_step = 1}).grains, 50000);
}

/// 0.5 s at 2,000 in a second: as many come in as are there.
TEST(Memory, GrainsThatComeInCount) {
  Config c = dune();
  const double without = memory_of_case(c, kSizes);
  c.grains->feed = FeedConfig{.rate = 2000};
  EXPECT_DOUBLE_EQ(memory_of_case(c, kSizes) - without, 1000 * 1000.0);
  const PartSeconds parts{.exchange = 1, .grain_step = 1};
  Config unfed = c;
  unfed.grains->feed.reset();
  const RunSeconds more = run_seconds({c, kSizes}, parts),
                   less = run_seconds({unfed, kSizes}, parts);
  EXPECT_DOUBLE_EQ(more.exchange / less.exchange, 1.5) << "half of them on average";
  EXPECT_DOUBLE_EQ(more.grains / less.grains, 1.5);
  c.grains->feed->start = 0.25;
  EXPECT_DOUBLE_EQ(fed_grains(c), 500);
}

TEST(RunSeconds, CountOutputAndStatistics) {
  Config c = dune();
  c.output.dune_interval = 0.05;
  EXPECT_DOUBLE_EQ(run_seconds({c, kSizes}, {.dunes = 7}).output, 70);
  c.statistics = StatisticsConfig{.start = 0.3, .interval = 0.01};
  EXPECT_NEAR(run_seconds({c, kSizes}, {.sample = 2}).output, 40, 1e-9);
  c.output.grains_interval = 1e-9;  // a frame after every step, no more
  const double frames = run_seconds({c, kSizes}, {}).output;
  EXPECT_GT(frames, 0);
  c.time.end *= 2;
  EXPECT_NEAR(run_seconds({c, kSizes}, {}).output, 2 * frames, 1e-9);
}

// A list is good for as long as the fastest grain stays within the widest skin, 0.4 diameters.
TEST(RebuildRate, FollowsTheFastestGrains) {
  Config c = dune();
  const double rate = rebuild_rate({c, kSizes});  // at 0.4 of 0.2 m/s, from a skin of 0.02 mm
  EXPECT_NEAR(rate, 0.08 / (1.25e-4 + 6 * 2e-5 - 2e-5), 1e-6 * rate);
  c.fluid->mean_velocity = 0.4;
  EXPECT_NEAR(rebuild_rate({c, kSizes}), 2 * rate, 1e-6 * rate);
  c.fluid.reset();
  c.grains->ambient = AmbientConfig{};
  EXPECT_LT(rebuild_rate({c, kSizes}), rate / 2);  // they fall at some 20 mm/s
}

TEST(PackedGrains, TouchAsInAHeapAtRest) {
  for (const auto& sizes : {kSizes, std::vector<SizeClass>{{2e-4, 1000}}}) {
    const InitialGrains g = packed_grains(
        {{.centre = {0.01, 0.006}, .radius = 0.003, .sizes = sizes}}, {0.02, 0.02, 0.012});
    double touching = 0;
    for (std::size_t a = 0; a < g.size(); ++a) {
      EXPECT_GE(g.x[a].y, g.diameter[a] / 2);
      for (std::size_t b = 0; b < a; ++b) {
        const double overlap = (g.diameter[a] + g.diameter[b]) / 2 - norm(g.x[a] - g.x[b]);
        if (overlap > 0) ++touching;
        ASSERT_LT(overlap, 0.5 * 2.5e-4);
      }
    }
    // Settled heaps of 3,000 to 100,000 grains have 1.9 to 2.4 contacts a grain, and a heap so
    // small has a wide surface.
    EXPECT_GT(touching / 1000, 1.0);
    EXPECT_LT(touching / 1000, 2.4);
  }
}

/// A folder with a table of two grains and cases that use it.
class PlannedGrainsTest : public ::testing::Test {
 protected:
  PlannedGrainsTest() {
    write("grains.csv", "id,diameter,x,y,z\n1,2e-4,0.004,2e-4,0.003\n2,1.5e-4,0.006,2e-4,0.003\n");
    write("table.toml", text("\"grains.csv\""));
    write("poured.toml", text("{ pour = { centre = [0.005, 0.003], radius = 0.001 } }") +
                             "[grains]\nsizes = [[2e-4, 30]]\n");
    write("after.toml", text("\"poured.toml\""));
  }
  static std::string text(const std::string& grains) {
    return "[case]\ntitle = \"t\"\n[time]\nend = 2e-4\nfluid_step = 1e-4\n[domain]\nsize = "
           "[0.01, 0.01, 0.006]\n[initial]\ngrains = " +
           grains + "\n" + (grains.starts_with("{") ? "" : "[grains]\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  PlannedGrains planned(const std::string& name) const {
    return planned_grains(load_case(folder_ / name), folder_ / "runs/case");
  }

  const TemporaryFolder folder_;
};

TEST_F(PlannedGrainsTest, ATableIsCounted) {
  const PlannedGrains grains = planned("table.toml");
  EXPECT_EQ(grains.settled.sizes, (std::vector<SizeClass>{{1.5e-4, 1}, {2e-4, 1}}));
  ASSERT_TRUE(grains.grains.has_value());
  EXPECT_EQ(grains.grains->size(), 2u);
}

TEST_F(PlannedGrainsTest, ATableThatTheRunWouldRefuseIsRefused) {
  write("grains.csv", "id,x,y,z\n1,0.004,2e-4,0.003\n");
  EXPECT_TRUE(contains(message_of([&] { planned("table.toml"); }), "\"diameter\" is missing"));
  write("grains.csv", "id,diameter,x,y,z\n1,2e-5,0.004,2e-4,0.003\n");
  EXPECT_TRUE(contains(message_of([&] { planned("table.toml"); }), "Rayleigh"));
  write("grains.csv", "id,diameter,x,y,z\n1,2e-4,0.4,2e-4,0.003\n");
  EXPECT_THROW(planned("table.toml"), InputError);
}

TEST_F(PlannedGrainsTest, OfAStartThoseThatItPoursUntilItHasResults) {
  const Case the_case = load_case(folder_ / "after.toml");
  PlannedGrains grains = planned("after.toml");
  EXPECT_EQ(grains.settled.sizes, (std::vector<SizeClass>{{2e-4, 30}}));
  EXPECT_FALSE(grains.grains.has_value());
  EXPECT_EQ(grains.poured_in.config.title, "t");
  const auto missing = missing_starts(the_case, folder_ / "runs/case");
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].folder.filename(), "poured");
  Simulation(missing[0].realised.config, {.folder = missing[0].folder, .restart = {}}, {}).run();
  EXPECT_TRUE(missing_starts(the_case, folder_ / "runs/case").empty());
  grains = planned("after.toml");
  ASSERT_TRUE(grains.grains.has_value());
  EXPECT_EQ(grains.grains->size(), 30u);
}

// Times differ from hour to hour; a factor of five is what no hour makes of a right estimate.
TEST(Estimate, IsNearWhatTheRunTakes) {
  const TemporaryFolder folder;
  const Case the_case =
      load_case(BARCHAN_SOURCE_DIR "/tests/support/small_dune.toml",
                {"time.end=0.1", "output.history_interval=0.05", "output.grains_interval=0.05"});
  const Config& config = the_case.config;
  const PlannedGrains planned = planned_grains(the_case, folder / "run");
  const auto pilot = packed_grains(poured_heaps(config), config.size);
  const double estimated = run_seconds(planned.settled, time_parts(config, pilot, 0.2)).all();
  Simulation simulation(config, {.folder = folder / "run", .restart = {}}, {});
  const auto start = WallClock::now();
  simulation.run();
  const double taken = seconds_since(start);
  EXPECT_GT(estimated, taken / 5);
  EXPECT_LT(estimated, taken * 5);
}

// This flow goes wrong in its first steps over grains that are held.
TEST(Estimate, ATrialThatGoesWrongIsTimedAllTheSame) {
  const TemporaryFolder folder;
  const Case the_case = load_case(BARCHAN_SOURCE_DIR "/configs/validation/laminar-bed.toml");
  const std::string said =
      estimate(the_case, folder / "run", planned_grains(the_case, folder / "run"));
  EXPECT_TRUE(contains(said, "timed just now")) << said;
}

TEST(Estimate, OfManyGrainsIsMoreThanOfFew) {
  const Config config = load_config(BARCHAN_SOURCE_DIR "/tests/support/small_dune.toml");
  HeapConfig heap = *config.initial.pour;
  heap.sizes = {{2e-4, 100}};
  const auto few = packed_grains({heap}, config.size);
  heap.shape = HeapShape::bed;
  heap.sizes = {{2e-4, 5000}};
  const auto many = packed_grains({heap}, config.size);
  EXPECT_GT(time_parts(config, many, 0.1).grain_step, 5 * time_parts(config, few, 0.1).grain_step);
}

TEST(Check, TellsTheTimeTheStartsAndNarrowCells) {
  CommandLine line;
  line.file = BARCHAN_SOURCE_DIR "/configs/quickstart.toml";
  const TemporaryFolder folder;
  line.out = folder / "quickstart";
  std::ofstream(folder / "grains.csv") << "id,diameter,x,y,z\n1,2e-4,0.004,2e-4,0.003\n";
  line.overrides = {"fluid.cells=[300,46,150]", "fluid.first_cell_height=1.54e-4",
                    "initial.fluid=\"turbulent\"", "time.fluid_step=1e-4",
                    "initial.grains=\"" + (folder / "grains.csv").string() + "\""};
  std::ostringstream out;
  EXPECT_EQ(run_check(line, out), 0);
  EXPECT_TRUE(contains(out.str(), "  grains                  1, d 0.2 to 0.2")) << out.str();
  EXPECT_TRUE(contains(out.str(), "  wall time               about "));
  EXPECT_TRUE(
      contains(out.str(),
               "row height / grain      0.77 at the floor, 0.77 at 0.3 mm, the top of the grains"));
  line.overrides.clear();
  out.str("");
  EXPECT_EQ(run_check(line, out), 0);
  for (const char* start : {"channel-small", "heap-3k"})
    EXPECT_TRUE(contains(out.str(), "before that: " + std::string(start))) << out.str();
}

}  // namespace
}  // namespace barchan
