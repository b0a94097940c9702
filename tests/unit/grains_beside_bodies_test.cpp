// Grains beside bodies at rest: start, feed and checks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "src/app/memory.hpp"
#include "src/base/errors.hpp"
#include "src/bodies/make_bodies.hpp"
#include "src/case/config.hpp"
#include "src/coupling/state_checks.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/pour.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using test::CoupledRun;

constexpr Real d = 2e-4;
const std::array<double, 3> kSize{0.02, 0.02, 0.012};
const std::vector<SizeClass> kSizes = {{1.5e-4, 50}, {2e-4, 900}, {2.5e-4, 50}};

BodyConfig post(std::array<double, 2> centre, double radius) {
  return {.name = "post",
          .shape = BodyShape::of<shapes::Cylinder>(),
          .centre = centre,
          .radius = radius,
          .height = 0.004};
}

Config box_with(const BodyConfig& body) {
  Config c = test::still_water({0.012, 0.006, 0.004});
  c.bodies = {body};
  return c;
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

template <class Error, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(GrainsBesideBodies, AHeapIsPouredAroundAPost) {
  Config c;
  c.size = kSize;
  c.bodies = {post({0.01, 0.006}, 0.001)};
  const Bodies bodies = make_bodies(c.bodies, c.size);
  for (const HeapShape shape : {HeapShape::cone, HeapShape::bed}) {
    const HeapConfig heap{.shape = shape,
                          .centre = {0.01, 0.006},
                          .radius = 0.003,
                          .sizes = kSizes,
                          .drop_height = 5e-4,
                          .seed = 3};
    for (const bool packed : {false, true}) {
      const InitialGrains g =
          packed ? packed_grains({heap}, kSize, bodies) : pour_grains({heap}, kSize, bodies);
      ASSERT_EQ(g.size(), 1000u);
      std::size_t beside = 0;
      for (std::size_t n = 0; n < g.size(); ++n) {
        const Real distance = bodies.body[0].distance(g.x[n]);
        EXPECT_GE(distance, (1 - 1e-12) * g.diameter[n] / 2);
        beside += distance < g.diameter[n] ? 1 : 0;
      }
      EXPECT_GT(beside, shape == HeapShape::cone ? 5u : 0u) << "it is to reach the post";
    }
  }
}

TEST(GrainsBesideBodies, APourWithoutBodiesStaysWhatItWas) {
  const std::vector<HeapConfig> heaps{{.centre = {0.01, 0.006}, .radius = 0.003, .sizes = kSizes}};
  const InitialGrains plain = pour_grains(heaps, kSize), other = pour_grains(heaps, kSize, {});
  ASSERT_EQ(plain.size(), other.size());
  for (std::size_t n = 0; n < plain.size(); ++n) EXPECT_EQ(norm(plain.x[n] - other.x[n]), 0);
}

TEST(GrainsBesideBodies, GrainsOfAFileThatLieInABodyAreRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "grains.csv";
  std::ofstream(path) << "id,diameter,x,y,z\n"
                         "1,2e-4,0.002,0.001,0.002\n"
                         "2,2e-4,0.006,0.001,0.0021\n"
                         "3,2e-4,0.006,0.001,0.0029\n"
                         "4,2e-4,0.00695,0.001,0.002\n"   // by a quarter
                         "5,2e-4,0.00708,0.002,0.002\n";  // by a tenth
  Config c = box_with(post({0.006, 0.002}, 0.001));
  c.grains->max_overlap = 0.05;
  expect_words(message_of<InputError>([&] { checked_grains(c, path); }),
               {"4 grains lie in body \"post\"", "more than 5 %", "(grains.max_overlap)",
                "the deepest grain 2", "body.1.centre"});
  c.grains->max_overlap = 0.2;
  expect_words(message_of<InputError>([&] { checked_grains(c, path); }), {"3 grains lie in body"});
  c.grains->frozen = true;  // these may reach into it
  const std::string frozen = message_of<InputError>([&] { checked_grains(c, path); });
  expect_words(frozen, {"3 grains lie in body", "more than 50 % of the diameter, the deepest"});
  c.bodies = {post({0.002, 0.003}, 5e-4)};
  EXPECT_EQ(message_of<InputError>([&] { checked_grains(c, path); }), "none");
}

TEST(GrainsBesideBodies, AFedGrainWaitsForRoomBesideABody) {
  Config c = box_with(post({0.001, 0.0012}, 0.0011));
  c.grains->boundary_x = GrainBoundaryX::exit;
  c.grains->feed = FeedConfig{.rate = 4000, .x = 1e-3};
  InitialGrains start;
  test::add_grain(start, d, {0.009, 0.001, 0.003});
  CoupledRun run(c, start);
  run.advance(40);
  const GrainState& grains = *run.state.grains;
  EXPECT_GT(grains.feed.n_fed, 2);
  EXPECT_GT(n_waiting(grains.feed), 0);
  const auto kin = host_copy(grains.kin);
  for (int g = 0; g < grains.n; ++g)
    EXPECT_GE(run.step.grain_solver()->bodies().body[0].distance(kin(g).x), kin(g).r);
  // Nowhere is room: all wait.
  c.bodies = {post({0.001, 0.002}, 0.002)};
  c.grains->feed->x = 5e-4, c.grains->feed->across = {0.0012, 0.0028};
  CoupledRun none(c, start);
  none.advance(40);
  EXPECT_EQ(none.state.grains->feed.n_fed, 0);
  EXPECT_EQ(n_waiting(none.state.grains->feed), 40);
}

TEST(GrainsBesideBodies, AGrainPressedIntoABodyStopsTheRunWithItsName) {
  const Config c = box_with(post({0.006, 0.002}, 0.001));
  for (const bool through : {false, true}) {
    InitialGrains start;
    test::add_grain(start, d, {0.007 + (through ? -0.1 : 0.3) * d, 0.001, 0.002});
    const CoupledRun run(c, start);
    const auto check = [&] { StateChecks(c, MPI_COMM_SELF).check(run.state, run.step); };
    const std::string text = message_of<StateError>(check);
    if (through) {
      expect_words(text, {"grain 1", "has gone through body \"post\""});
    } else {
      expect_words(text, {"grain 1", "20.0 % of its diameter into body \"post\""});
    }
  }
}

TEST(GrainsBesideBodies, HistoriesTakeMemory) {
  const std::vector<SizeClass> sizes{{2e-4, 1000}};
  Config c = test::still_water(kSize);
  const double without = memory_of_case(c, sizes);
  c.bodies = {post({0.006, 0.002}, 0.001)};
  const double one = memory_of_case(c, sizes);
  c.bodies.resize(8, c.bodies[0]);
  EXPECT_GT(one, without + 48e3);
  EXPECT_DOUBLE_EQ(memory_of_case(c, sizes), one + 7 * 48e3);
}

}  // namespace
}  // namespace barchan
