// Whole runs: reproducible to the bit, across a restart too, and every grain accounted for.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src/base/atomic_file.hpp"
#include "src/initial/grain_files.hpp"
#include "src/io/frame_file.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/run/simulation.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/whole_run.hpp"

namespace barchan {
namespace {

using test::coupled_config;
using test::expect_same_state;
using test::run_to_end;

TEST(Simulation, TwoRunsAreBitwiseIdentical) {
  const TemporaryFolder scratch;
  const Config config = coupled_config();
  expect_same_state(run_to_end(config, scratch / "a"), run_to_end(config, scratch / "b"));
}

TEST(Simulation, RestartContinuesBitwise) {
  const TemporaryFolder scratch;
  Config whole = coupled_config();
  whole.grains->floor = GrainFloor::glued;  // three histories of contact with the floor
  whole.grains->floor_diameter = 2e-4;
  whole.bodies = {{.name = "post",
                   .shape = BodyShape::of<shapes::Cylinder>(),
                   .centre = {0.008, 0.003},
                   .radius = 5e-4,
                   .height = 0.002}};
  whole.statistics.emplace();
  whole.statistics->interval = 2 * whole.time.fluid_step;
  whole.statistics->fields = whole.statistics->grain_forces = true;
  whole.output.probes = {{.name = "point", .at = {{0.01, 0.003, 0.003}}, .interval = 1e-9},
                         {.name = "line",
                          .from = {{0.002, 0, 0.001}},
                          .to = {{0.002, 0.003, 0.001}},
                          .points = 4,
                          .interval = 3 * whole.time.fluid_step}};
  Config half = whole;
  half.time.end = whole.time.end / 2;
  const auto at_once = run_to_end(whole, scratch / "whole");
  const auto middle = run_to_end(half, scratch / "parts");
  const auto touching = CheckpointReader(middle).array<std::int64_t>("grains/body_touching");
  EXPECT_GT(std::ranges::count_if(touching, [](std::int64_t bits) { return bits != 0; }), 0);
  const auto in_parts = run_to_end(whole, scratch / "parts", middle);
  expect_same_state(at_once, in_parts);
  for (const char* table :
       {"history.csv", "dune.csv", "bodies.csv", "probes.csv", "statistics.csv", "force_map.csv"}) {
    const std::string text = read_text(scratch / "whole" / table);
    EXPECT_GT(text.size(), 500u) << table;
    EXPECT_EQ(text, read_text(scratch / "parts" / table)) << table;
  }
}

TEST(Simulation, RestartOfAFlowAroundABodyContinuesBitwise) {
  for (const bool with_grains : {false, true}) {
    SCOPED_TRACE(with_grains);
    const TemporaryFolder scratch;
    Config whole = coupled_config();
    if (!with_grains) whole.grains.reset(), whole.initial.pour.reset();
    BodyConfig post;
    post.name = "post", post.shape = BodyShape::of<shapes::Cylinder>();
    post.centre = {0.0093, 0.0031};
    post.radius = 0.00083, post.height = 0.0041;
    whole.bodies = {post};
    Config half = whole;
    half.time.end = whole.time.end / 2;
    const auto at_once = run_to_end(whole, scratch / "whole");
    const auto middle = run_to_end(half, scratch / "parts");
    expect_same_state(at_once, run_to_end(whole, scratch / "parts", middle));
  }
}

/// Case of a window that follows its dune, with grains that leave, come in and wait.
Config fed_config() {
  Config config = coupled_config();
  config.fluid->mean_velocity = 0.5;
  config.grains->boundary_x = GrainBoundaryX::follow;
  config.grains->feed = FeedConfig{.rate = 2000, .x = 2e-3, .across = {2e-3, 3e-3}};
  config.time.end = 400 * config.time.fluid_step;
  config.output.dune_interval = 5 * config.time.fluid_step;
  return config;
}

TEST(Simulation, RestartInTheMiddleOfAFeedContinuesBitwise) {
  for (const FeedAmount amount : {FeedAmount::given, FeedAmount::as_lost}) {
    const TemporaryFolder scratch;
    Config whole = fed_config();
    whole.grains->feed->amount = amount;
    Config half = whole;
    half.time.end = whole.time.end / 2;
    const auto at_once = run_to_end(whole, scratch / "whole");
    const auto middle = run_to_end(half, scratch / "parts");
    expect_same_state(at_once, run_to_end(whole, scratch / "parts", middle));
    for (const char* table : {"history.csv", "dune.csv"})
      EXPECT_EQ(read_text(scratch / "whole" / table), read_text(scratch / "parts" / table));
    const CheckpointReader first(middle), last(at_once);
    EXPECT_GT(std::abs(last.real("grains/seam_x") - 0.002), 5e-4) << "the window is to move";
    EXPECT_GT(first.integer("feed/n_fed"), 0);
    EXPECT_GT(last.integer("feed/n_fed"), first.integer("feed/n_fed"));
    const auto inside = static_cast<std::int64_t>(last.array<std::int64_t>("grains/id").size());
    const std::int64_t left = last.integer("grains/n_left"), fed = last.integer("feed/n_fed");
    EXPECT_GT(left, 0) << "the case is meant to lose grains";
    EXPECT_EQ(inside, 200 + fed - left);
    const auto json = nlohmann::json::parse(read_text(scratch / "parts/run.json"));
    EXPECT_EQ(json.at("grains_fed"), fed);
    EXPECT_EQ(json.at("grains_left"), left);
    if (amount == FeedAmount::as_lost) {
      EXPECT_EQ(json.at("grains_waiting"), left - fed);
    } else {
      EXPECT_EQ(json.at("grains_waiting"), 200 - fed) << "2,000 in a second, 0.1 s";
    }
  }
}

TEST(Simulation, AFeedBeginsAtARestartToo) {
  const TemporaryFolder scratch;
  Config config = fed_config();
  config.time.end = 20 * config.time.fluid_step;
  Config unfed = config;
  unfed.grains->feed.reset();
  const auto middle = run_to_end(unfed, scratch / "run");
  config.grains->feed->start = config.time.end;
  config.time.end *= 2;
  const CheckpointReader last(run_to_end(config, scratch / "run", middle));
  EXPECT_GT(last.integer("feed/n_fed"), 0);
  EXPECT_DOUBLE_EQ(last.real("feed/due"), 2000 * 20 * config.time.fluid_step);
}

/// The grain with the largest number leaves before the feed begins; its number is not given again,
/// nor are those of fed grains by a case that starts from the end.
TEST(Simulation, ANumberIsNeverGivenTwice) {
  const TemporaryFolder scratch;
  std::ofstream(scratch / "grains.csv") << "id,diameter,x,y,z,vx\n"
                                           "1,2e-4,0.006,0.001,0.003,0\n"
                                           "2,2e-4,0.006,0.002,0.003,0\n"
                                           "50,2e-4,0.0115,0.003,0.003,0.1\n";
  Config config = coupled_config();
  config.fluid.reset();
  config.initial = {};
  config.initial.grains = scratch / "grains.csv";
  config.grains->gravity = {0, 0, 0};
  config.time.end = 40 * config.time.fluid_step;
  const InitialFiles table{.fluid = {}, .grains = config.initial.grains};
  Simulation first(config, {.folder = scratch / "run", .restart = {}}, table);
  first.run();
  ASSERT_EQ(first.state().grains->n, 2) << "one is meant to leave";
  config.grains->feed = FeedConfig{.rate = 1000, .x = 2e-3, .height = 2e-3};
  config.time.end *= 2;
  const auto last = run_to_end(config, scratch / "run", first.last_restart());
  const CheckpointReader end(last);
  const auto numbers = end.array<std::int64_t>("grains/id");
  const std::int64_t fed = end.integer("feed/n_fed");
  EXPECT_GE(fed, 5);
  EXPECT_EQ(std::ranges::max(numbers), 50 + fed);
  EXPECT_EQ(std::ranges::count_if(numbers, [](auto id) { return id > 2 && id <= 50; }), 0);
  EXPECT_EQ(read_grains(last).last_id, 50 + fed);
}

TEST(Simulation, AWindowThatFollowsRefusesGrainsAtItsEdge) {
  const TemporaryFolder scratch;
  Config config = fed_config();
  config.initial.pour->shape = HeapShape::bed;  // its grains lie everywhere
  config.initial.pour->radius = 0;
  config.grains->sizes = {{2e-4, 3000}};
  config.grains->feed.reset();
  try {
    run_to_end(config, scratch / "run");
    FAIL();
  } catch (const std::runtime_error& problem) {
    EXPECT_NE(std::string(problem.what()).find("half a box from the largest dune"),
              std::string::npos)
        << problem.what();
  }
  EXPECT_FALSE(std::filesystem::exists(scratch / "run" / "config.toml"));
}

TEST(Simulation, StartsDifferWhenTheSeedDoes) {
  const TemporaryFolder scratch;
  Config config = coupled_config();
  config.time.end = 2 * config.time.fluid_step;
  const CheckpointReader a(run_to_end(config, scratch / "a"));
  config.initial.seed = 2;
  const CheckpointReader b(run_to_end(config, scratch / "b"));
  EXPECT_NE(a.array<double>("fluid/u_x"), b.array<double>("fluid/u_x"));
}

TEST(Simulation, GrainsThatLeaveAreCounted) {
  const TemporaryFolder scratch;
  Config config = coupled_config();
  config.fluid->mean_velocity = 0.5;
  config.initial.pour->centre = {0.0101, 0.003};
  config.time.end = 80 * config.time.fluid_step;
  const CheckpointReader end(run_to_end(config, scratch / "run"));
  const auto inside = static_cast<std::int64_t>(end.array<std::int64_t>("grains/id").size());
  EXPECT_EQ(inside + end.integer("grains/n_left"), 200);
  EXPECT_GT(end.integer("grains/n_left"), 0) << "the case is meant to lose grains";
  EXPECT_LT(end.integer("grains/n_left"), 200);
  EXPECT_EQ(nlohmann::json::parse(read_text(scratch / "run/run.json")).at("grains_initial"), 200);
}

TEST(Simulation, AStateThatWentWrongStopsTheRunAndIsThereToLookAt) {
  const TemporaryFolder scratch;
  Config config = coupled_config();
  config.grains->material.youngs_modulus = config.grains->wall.youngs_modulus = 2e3;
  config.grains->gravity = {0, -200, 0};
  config.restart.interval = config.time.fluid_step;
  std::string said;
  try {
    run_to_end(config, scratch / "run");
  } catch (const std::runtime_error& problem) {
    said = problem.what();
  }
  for (const char* words : {"grain ", "(at most 10 %)", "grains.youngs_modulus", "(t = ", "step ",
                            "failure_grains.xdmf", "failure_fields.xdmf"}) {
    EXPECT_NE(said.find(words), std::string::npos) << words << ": " << said;
  }
  for (const char* name : {"failure_grains.h5", "failure_fields.h5"}) {
    const Hdf5File file(scratch / "run" / name, Hdf5File::Mode::read);
    const auto frames = list_frames(file);
    ASSERT_EQ(frames.size(), 1u) << name;
    EXPECT_GT(frames[0].arrays.size(), 4u) << name;
  }
  EXPECT_EQ(status_in(scratch / "run/run.json"), "failed");
  EXPECT_TRUE(latest_checkpoint(scratch / "run")) << "the last good state must be kept";
  // A new run in the folder is not about that failure.
  run_to_end(coupled_config(), scratch / "run");
  EXPECT_FALSE(std::filesystem::exists(scratch / "run" / "failure_grains.h5"));
}

TEST(Simulation, WritesEveryFileOfARun) {
  const TemporaryFolder scratch;
  Config config = coupled_config();
  config.time.end = 20 * config.time.fluid_step;
  config.output.grain_forces = true;
  config.output.tracks_interval = 5 * config.time.fluid_step;
  config.statistics.emplace();
  config.statistics->fields = config.statistics->grain_forces = true;
  config.statistics->interval = config.time.fluid_step;
  run_to_end(config, scratch / "run");
  for (const char* name : {"config.toml", "run.json", "history.csv", "dune.csv", "fields.h5",
                           "fields.xdmf", "grains.h5", "grains.xdmf", "log.txt", "tracks.h5",
                           "statistics.csv", "flow_average.h5", "flow_average.xdmf"}) {
    EXPECT_TRUE(std::filesystem::exists(scratch / "run" / name)) << name;
  }
  for (const char* name : {"grains.h5", "tracks.h5"}) {
    const Hdf5File file(scratch / "run" / name, Hdf5File::Mode::read);
    const auto n = file.info("frame_000000/id").extents;
    EXPECT_EQ(file.read<std::int32_t>("frame_000000/dune").size(), n[0]) << name;
  }
  const auto json = nlohmann::json::parse(read_text(scratch / "run" / "run.json"));
  EXPECT_EQ(json.at("status"), "done");
  EXPECT_EQ(json.at("steps"), 20);
  std::istringstream keys(
      "message title version git_hash backend device threads ranks simulated_seconds fluid_step "
      "wall_seconds "
      "phases grain_steps_per_second cell_steps_per_second pressure_iterations_mean "
      "pressure_iterations_max max_cfl max_overlap max_continuity_residual ledger grains_initial "
      "grains_inside grains_left");
  for (std::string key; keys >> key;) EXPECT_TRUE(json.contains(key)) << key;
  for (const char* phase : {"exchange", "grains", "deposit", "fluid", "pressure", "state_checks",
                            "output", "analytics"}) {
    EXPECT_TRUE(json.at("phases").contains(phase)) << phase;
  }
  EXPECT_TRUE(json.at("ledger").contains("largest_volume_mismatch"));
}

}  // namespace
}  // namespace barchan
