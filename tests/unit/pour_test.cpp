#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/config/config.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {
namespace {

const std::vector<SizeClass> kSizes = {{1.5e-4, 50}, {2e-4, 900}, {2.5e-4, 50}};
const PourConfig kPour{.centre = {0.01, 0.006}, .radius = 0.003, .drop_height = 0.0005, .seed = 3};

TEST(Pour, PlacesEveryGrainInsideTheConeWithoutOverlap) {
  const InitialGrains g = pour_grains(kPour, kSizes, {0.02, 0.02, 0.012});
  ASSERT_EQ(g.size(), 1000u);
  EXPECT_EQ(std::count(g.diameter.begin(), g.diameter.end(), 1.5e-4), 50);
  EXPECT_EQ(std::count(g.diameter.begin(), g.diameter.end(), 2.5e-4), 50);
  for (std::size_t a = 0; a < g.size(); ++a) {
    EXPECT_GT(g.x[a].y - g.diameter[a] / 2, 0.0005 - 1e-6);
    EXPECT_LT(std::hypot(g.x[a].x - 0.01, g.x[a].z - 0.006), 0.00301);
    for (std::size_t b = 0; b < a; ++b) {
      ASSERT_GT(norm(g.x[a] - g.x[b]), (g.diameter[a] + g.diameter[b]) / 2);
    }
  }
}

TEST(Pour, TheSeedDecides) {
  const std::array<double, 3> size{0.02, 0.02, 0.012};
  const InitialGrains a = pour_grains(kPour, kSizes, size), b = pour_grains(kPour, kSizes, size);
  EXPECT_EQ(a.diameter, b.diameter);
  EXPECT_EQ(a.x[500].x, b.x[500].x);
  PourConfig other = kPour;
  other.seed = 4;
  EXPECT_NE(pour_grains(other, kSizes, size).diameter, a.diameter);
}

TEST(Pour, RefusesAConeThatDoesNotFit) {
  EXPECT_THROW(pour_grains(kPour, kSizes, {0.02, 0.001, 0.012}), std::runtime_error);
  PourConfig edge = kPour;
  edge.centre[0] = 0.001;
  EXPECT_THROW(pour_grains(edge, kSizes, {0.02, 0.02, 0.012}), std::runtime_error);
}

}  // namespace
}  // namespace barchan
