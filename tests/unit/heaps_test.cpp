// Several heaps and beds: counts, places, order, and the heap that each grain came from.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "src/app/info_path.hpp"
#include "src/case/heaps.hpp"
#include "src/case/load.hpp"
#include "src/initial/crater.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/pour.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using test::only;
using test::problems;

const std::array<double, 3> kSize{0.02, 0.02, 0.008};

HeapConfig heap(HeapShape shape, double x, double radius, const std::vector<SizeClass>& sizes) {
  HeapConfig one;
  one.shape = shape;
  one.centre = {x, 0.004};
  one.radius = radius;
  one.sizes = sizes;
  return one;
}

/// A bed with a cone and a ridge on it.
std::vector<HeapConfig> three() {
  return {heap(HeapShape::bed, 0, 0, {{2e-4, 9000}}),
          heap(HeapShape::cone, 0.004, 0.003, {{2e-4, 700}, {2.5e-4, 100}}),
          heap(HeapShape::ridge, 0.015, 0.003, {{1.5e-4, 3000}})};
}

/// Smallest distance of the surfaces of two grains, through both periodic sides [m].
double least_gap(const InitialGrains& g) {
  double least = 1;
  for (std::size_t a = 0; a < g.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3 d = g.x[a] - g.x[b];
      if (std::abs(d.y) > 3e-4) continue;
      const Vec3 near{std::remainder(d.x, kSize[0]), d.y, std::remainder(d.z, kSize[2])};
      least = std::min(least, norm(near) - (g.diameter[a] + g.diameter[b]) / 2);
    }
  }
  return least;
}

TEST(Heaps, AreNumberedInTheirOrderAndGrainsKnowTheirs) {
  const InitialGrains g = pour_grains(three(), kSize);
  ASSERT_EQ(g.size(), 12800u);
  ASSERT_EQ(g.heap.size(), g.size());
  for (std::size_t n = 0; n < g.size(); ++n) {
    ASSERT_EQ(g.id[n], static_cast<std::int64_t>(n) + 1);
    ASSERT_EQ(g.heap[n], n < 9000 ? 0 : n < 9800 ? 1 : 2);
  }
  EXPECT_EQ(std::count(g.diameter.begin() + 9000, g.diameter.begin() + 9800, 2.5e-4), 100);
  EXPECT_EQ(std::count(g.diameter.begin() + 9800, g.diameter.end(), 1.5e-4), 3000);
}

TEST(Heaps, StandOnTheBedWithoutOverlapThroughPeriodicSidesNeither) {
  const InitialGrains g = pour_grains(three(), kSize);
  EXPECT_GT(least_gap(g), 0);
  double top = 0, left = 1, right = 0;
  for (std::size_t n = 0; n < 9000; ++n) top = std::max(top, g.x[n].y + g.diameter[n] / 2);
  for (std::size_t n = 9000; n < g.size(); ++n) {
    ASSERT_GE(g.x[n].y - g.diameter[n] / 2, top);
    if (n < 9800) {
      ASSERT_LT(std::hypot(g.x[n].x - 0.004, g.x[n].z - 0.004), 0.00301);
    } else {
      ASSERT_LT(std::abs(g.x[n].x - 0.015), 0.00301);
      left = std::min(left, g.x[n].z), right = std::max(right, g.x[n].z);
    }
  }
  // The ridge goes through the side: its two ends are as near as its rows.
  EXPECT_LT(left + kSize[2] - right, 2 * 1.01 * 1.5e-4);
}

/// Sites of a close packing fill 1/sqrt(2) spacing^3 each; the triangle of a ridge has half the
/// area of its box.
TEST(Heaps, ARidgeIsATriangleAsHighAsItsGrainsMakeIt) {
  const HeapConfig ridge = heap(HeapShape::ridge, 0.01, 0.003, {{1.5e-4, 12000}});
  const InitialGrains g = pour_grains({ridge}, kSize);
  EXPECT_TRUE(g.heap.empty()) << "of one heap alone nothing is kept";
  const double spacing = 1.01 * 1.5e-4, sites = 12000 / std::numbers::sqrt2;
  const double height = sites * std::pow(spacing, 3) / (0.003 * kSize[2]);
  EXPECT_NEAR(poured_height(ridge, kSize), height, 1e-9 * height);
  double top = 0, mean = 0, distance = 0;
  for (const Vec3& x : g.x) {
    top = std::max(top, x.y);
    mean += x.y / 12000, distance += std::abs(x.x - 0.01) / 12000;
  }
  EXPECT_NEAR(top, height, 3 * spacing);
  EXPECT_NEAR(mean, height / 3, 0.5 * spacing);
  EXPECT_NEAR(distance, 0.003 / 3, 0.5 * spacing);
}

TEST(Heaps, SeedsOfARealisationDiffer) {
  Config c;
  c.grains.emplace().sizes = {{2e-4, 10}};
  c.initial.heaps = {heap(HeapShape::cone, 0.004, 0.003, {}),
                     heap(HeapShape::cone, 0.015, 0.003, {{1e-4, 5}})};
  c.initial.heaps[1].name = "small";
  c.initial.realisation = 3;
  const auto heaps = poured_heaps(c);
  ASSERT_EQ(heaps.size(), 2u);
  EXPECT_EQ(heaps[0].seed, 3u);
  EXPECT_EQ(heaps[0].name, "heap 1");
  EXPECT_EQ(heaps[1].name, "small");
  EXPECT_EQ(sizes_of(heaps), (std::vector<SizeClass>{{2e-4, 10}, {1e-4, 5}}));
}

// --- Mistakes.

std::string heaps_case(const std::string& heaps) {
  return "[time]\nend = 1.0\n[domain]\nsize = [0.1, 0.025, 0.04]\n[grains]\n"
         "sizes = [[0.2e-3, 100]]\n" +
         heaps;
}

const std::string kTwo =
    "[[initial.heap]]\ncentre = [0.02, 0.02]\nradius = 0.006\n"
    "[[initial.heap]]\ncentre = [0.04, 0.02]\nradius = 0.006\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.rfind(from), from.size(), to);
}

/// `pour` has the shapes of a heap, its place by default, and no name.
TEST(Heaps, PourIsOneOfThem) {
  const auto poured = [](const std::string& text) {
    return poured_heaps(load_config_text(heaps_case(text), "case.toml"));
  };
  const auto pour = poured(
      "[initial]\ngrains = { pour = { shape = \"ridge\", radius = 0.006, seed = 7 } }\n"
      "realisation = 2\n");
  const auto heap = poured(
      "[initial]\nrealisation = 2\n[[initial.heap]]\nshape = \"ridge\"\ncentre = [0.02, 0.02]\n"
      "radius = 0.006\nseed = 7\n");
  ASSERT_EQ(heap.size(), 1u);
  EXPECT_EQ(heap[0].name, "heap 1");
  HeapConfig nameless = heap[0];
  nameless.name.clear();
  EXPECT_EQ(pour, std::vector{nameless});
  EXPECT_EQ(pour[0].seed, 8u);
}

TEST(Heaps, MistakesAreToldAtTheirLine) {
  EXPECT_EQ(problems(heaps_case(kTwo)), test::Lines{});
  const auto told = [](const std::string& from, const std::string& to, const std::string& line) {
    EXPECT_EQ(problems(heaps_case(replaced(kTwo, from, to))), only(line));
  };
  told("[0.04, 0.02]", "[0.04, 0.005]",
       "case.toml:12: [initial.heap.2] radius = 0.006: must keep the cone inside the domain; along "
       "z it spans -0.001 to 0.011 m of 0 to 0.04 m");
  told("[0.04,", "[0.0315,",
       "case.toml:11: [initial.heap.2] centre = [0.0315, 0.02]: must be at least 0.000702 m "
       "farther from \"heap 1\": the two heaps overlap");
  told("centre = [0.04, 0.02]\nradius = 0.006", "shape = \"bed\"",
       "case.toml:11: [initial.heap.2] shape = \"bed\": must stand before \"heap 1\": a bed lies "
       "under the heaps after it");
  told("radius = 0.006", "shape = \"ridge\"",
       "case.toml:10: [initial.heap.2] radius: must be above 0 for a ridge");
  told("radius = 0.006", "radius = 0.006\nname = \"heap 1\"",
       "case.toml:13: [initial.heap.2] name = \"heap 1\": must be another one: \"heap 1\" is the "
       "name of an earlier heap");
  for (const char* name : {"=1+1", "+1", "a,b", "a;b", "a\\nb", "a\\\"b", " a"})
    told(
        "radius = 0.006", fmt::format("radius = 0.006\nname = \"{}\"", name),
        fmt::format("case.toml:13: [initial.heap.2] name = \"{}\": must be one line without \",\", "
                    "\";\" and quotes, and must not begin with \"=\", \"+\", \"-\", \"@\" or a "
                    "space",
                    name));
  told("radius = 0.006", "radius = 0.006\ndrop_height = 0.025",
       "case.toml:12: [initial.heap.2] radius = 0.006: must be larger: the heap would reach about "
       "0.025 m, above the domain");
  told("radius = 0.006", "radius = 0.006\nraduis = 0.006",
       "case.toml:13: [initial.heap] raduis: unknown key (did you mean \"radius\"?)");
  EXPECT_EQ(problems(heaps_case("[[initial.heap]]\nshape = \"bed\"\ncentre = [0.04, 0.02]\n")),
            only("case.toml:9: [initial.heap.1] centre = [0.04, 0.02]: must be absent with shape = "
                 "\"bed\", which covers the floor"));
}

TEST(Heaps, ContradictionsAreErrors) {
  const std::string file = heaps_case(
      "[initial]\ngrains = { pour = { radius = 0.006, centre = "
      "[0.02, 0.02] } }\n" +
      kTwo);
  EXPECT_EQ(problems(file).front().substr(0, 43), "case.toml:9: [initial] heap = [{ centre = [");
  EXPECT_EQ(
      problems(replaced(heaps_case(kTwo), "sizes = [[0.2e-3, 100]]\n", "")).front(),
      "case.toml:5: [grains] sizes: must say which grains to pour: sizes = [[2e-4, 3000]] are "
      "3,000 of 0.2 mm");
  // The two are near each other through a periodic side, else not.
  const std::string edges = replaced(replaced(kTwo, "[0.02,", "[0.006,"), "[0.04,", "[0.094,");
  EXPECT_EQ(problems(heaps_case(edges)), test::Lines{});
  EXPECT_FALSE(problems(heaps_case("boundary_x = \"periodic\"\n" + edges)).empty());
}

TEST(Heaps, InfoTellsThem) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "case.toml";
  std::ofstream(path) << heaps_case(kTwo +
                                    "shape = \"ridge\"\nname = \"wall\"\nsizes = [[2e-4, 7000]]\n");
  const std::string told = describe_path(path);
  EXPECT_TRUE(contains(told,
                       "grains   7100\nheap     heap 1: cone of 100 grains\n"
                       "heap     wall: ridge of 7000 grains\n"))
      << told;
}

// --- Craters.

const CraterConfig kCrater{.centre = {0.011, 0.004}, .radius = 0.0035, .depth = 0.0012};

/// Twelve layers of close packed spheres, which fill 0.7405 / 1.01^3 of their space.
InitialGrains deep_bed() {
  return pour_grains({heap(HeapShape::bed, 0, 0, {{2e-4, 53000}})}, kSize);
}

TEST(Craters, TheVolumeTakenAwayIsThatOfTheParaboloid) {
  const InitialGrains before = deep_bed();
  InitialGrains after = before;
  cut_craters({kCrater}, after);
  const double solid =
      0.7405 / std::pow(1.01, 3) * std::numbers::pi * std::pow(0.0035, 2) * 0.0012 / 2;
  const double expected = solid / (std::numbers::pi / 6 * std::pow(2e-4, 3));
  const auto taken = static_cast<double>(before.size() - after.size());
  EXPECT_NEAR(taken, expected, 0.05 * expected);
}

TEST(Craters, OnlyWhatLiesAboveTheParaboloidGoes) {
  InitialGrains before = deep_bed();
  before.heap.assign(before.size(), 0);
  for (std::size_t g = 0; g < before.size(); ++g)
    before.heap[g] = static_cast<std::uint8_t>(before.id[g] % 7);
  InitialGrains after = before;
  cut_craters({kCrater}, after);
  ASSERT_EQ(after.heap.size(), after.size());
  std::size_t at = 0;
  double lowest_taken = -1, highest_kept = -1;  // against the paraboloid of a surface at 0
  for (std::size_t g = 0; g < before.size(); ++g) {
    const double r = std::hypot(before.x[g].x - 0.011, before.x[g].z - 0.004) / 0.0035;
    const double above = before.x[g].y + 0.0012 * (1 - r * r);
    const bool kept = at < after.size() && after.id[at] == before.id[g];
    if (kept) {
      ASSERT_EQ(after.heap[at], after.id[at] % 7);
      ASSERT_EQ(after.x[at].y, before.x[g].y);
      ++at;
      if (r < 1) highest_kept = std::max(highest_kept, above);
    } else {
      ASSERT_LT(r, 1);
      if (lowest_taken < 0 || above < lowest_taken) lowest_taken = above;
    }
  }
  EXPECT_EQ(at, after.size());
  EXPECT_GT(lowest_taken, highest_kept);
}

TEST(Craters, AreCutInGrainsOfAnySourceAndMistakesAreTold) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "grains.csv";
  std::ofstream(path) << "id,diameter,x,y,z\n1,2e-4,1e-3,1e-3,1e-3\n2,2e-4,5e-3,1e-3,1e-3\n";
  Config config;
  config.size = kSize;
  config.grains.emplace();
  config.initial.craters = {{.centre = {0.005, 0.001}, .radius = 5e-4, .depth = 5e-4}};
  EXPECT_EQ(checked_grains(config, path).id, (std::vector<std::int64_t>{1}));
  config.initial.craters[0].depth = 0.0012;
  EXPECT_TRUE(contains(message_of([&] { checked_grains(config, path); }),
                       "initial.crater.1: depth = 0.0012: must be at most 0.0011 m"));
  config.initial.craters[0].centre[0] = 0.015;
  EXPECT_TRUE(contains(message_of([&] { checked_grains(config, path); }),
                       "initial.crater.1: no grains lie within its rim"));
  EXPECT_EQ(problems(heaps_case(kTwo + "[[initial.crater]]\ncentre = [0.02, 0.02]\nradius = 0.021\n"
                                       "depth = 1e-3\n")),
            only("case.toml:15: [initial.crater.1] radius = 0.021: must keep the rim inside the "
                 "domain, 0 to 0.1 m along x and 0 to 0.04 m along z"));
}

// --- The heap of a grain in a table.

TEST(Heaps, ATableMayHoldThem) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "grains.csv";
  std::ofstream(path)
      << "id,diameter,x,y,z,heap\n1,2e-4,1e-3,1e-3,1e-3,0\n2,2e-4,2e-3,1e-3,1e-3,7\n";
  Config config;
  config.size = {0.1, 0.02, 0.05};
  config.grains.emplace();
  EXPECT_EQ(checked_grains(config, path).heap, (std::vector<std::uint8_t>{0, 7}));
  std::ofstream(path) << "id,diameter,x,y,z,heap\n1,2e-4,1e-3,1e-3,1e-3,255\n";
  EXPECT_TRUE(contains(message_of([&] { checked_grains(config, path); }),
                       "grains.csv:2: heap = 255: must be from 0 to 254, or -1"));
}

}  // namespace
}  // namespace barchan
