// Grains of a case: poured, or from a file into the domain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "src/initial/initial_state.hpp"
#include "src/initial/pour.hpp"
#include "tests/support/temporary_folder.hpp"

#include "src/config/config.hpp"

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

/// Without overlap, through the periodic sides neither.
TEST(Pour, ABedCoversTheFloorEvenly) {
  const std::array<double, 3> size{0.006, 0.01, 0.004};
  const InitialGrains g =
      pour_grains({.shape = PourShape::bed, .drop_height = 0.001}, kSizes, size);
  ASSERT_EQ(g.size(), 1000u);
  std::array<int, 4> quarters{};
  const auto apart = [](double distance, double period) {
    return std::remainder(distance, period);
  };
  for (std::size_t a = 0; a < g.size(); ++a) {
    EXPECT_GT(g.x[a].y - g.diameter[a] / 2, 0.001 - 1e-6);
    EXPECT_LT(g.x[a].y, 0.001 + 4 * 2.525e-4);
    ++quarters[(g.x[a].x < 0.003 ? 0u : 1u) + (g.x[a].z < 0.002 ? 0u : 2u)];
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3 d = g.x[a] - g.x[b];
      ASSERT_GT(norm(Vec3{apart(d.x, size[0]), d.y, apart(d.z, size[2])}),
                (g.diameter[a] + g.diameter[b]) / 2);
    }
  }
  for (const int quarter : quarters) EXPECT_NEAR(quarter, 250, 25);
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

// --- Grains of a file in the domain of a case.

/// Where a grain of a file ends up in a domain of 0.1 x 0.02 x 0.05 m; throws as
/// make_initial_state.
Vec3 placed(const Vec3& x, GrainBoundaryX sides) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "grains.csv";
  std::ofstream(path) << "id,diameter,x,y,z\n1,2e-4," << x.x << ',' << x.y << ',' << x.z << '\n';
  Config config;
  config.size = {0.1, 0.02, 0.05};
  config.grains.emplace().boundary_x = sides;
  const SystemState state = make_initial_state(config, {.fluid = {}, .grains = path});
  const auto kin = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, state.grains->kin);
  return kin(0).x;
}

// A run wraps positions at its list rebuilds only, so its restart may hold grains just outside.
TEST(InitialState, GrainsThatLeftThroughAPeriodicSideComeBackOnTheOther) {
  EXPECT_DOUBLE_EQ(placed({-0.01, 0.01, 0.02}, GrainBoundaryX::periodic).x, 0.09);
  EXPECT_DOUBLE_EQ(placed({0.125, 0.01, 0.02}, GrainBoundaryX::periodic).x, 0.025);
  EXPECT_DOUBLE_EQ(placed({0.05, 0.01, -0.01}, GrainBoundaryX::exit).z, 0.04);
  EXPECT_DOUBLE_EQ(placed({0.05, 0.01, 0.02}, GrainBoundaryX::exit).x, 0.05);
}

TEST(InitialState, GrainsOutsideAreRefused) {
  EXPECT_THROW(placed({-0.01, 0.01, 0.02}, GrainBoundaryX::exit), std::runtime_error);
  EXPECT_THROW(placed({0.125, 0.01, 0.02}, GrainBoundaryX::wall), std::runtime_error);
  EXPECT_THROW(placed({0.35, 0.01, 0.02}, GrainBoundaryX::periodic), std::runtime_error);
  EXPECT_THROW(placed({0.05, 0.03, 0.02}, GrainBoundaryX::periodic), std::runtime_error);
}

}  // namespace
}  // namespace barchan
