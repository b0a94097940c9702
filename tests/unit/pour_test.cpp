// Grains of a case: poured, or from a file into the domain.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <random>

#include "src/case/config.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/overlaps.hpp"
#include "src/initial/pour.hpp"
#include "src/parallel/mirror.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

const std::vector<SizeClass> kSizes = {{1.5e-4, 50}, {2e-4, 900}, {2.5e-4, 50}};
const HeapConfig kPour{
    .centre = {0.01, 0.006}, .radius = 0.003, .sizes = kSizes, .drop_height = 0.0005, .seed = 3};

TEST(Pour, PlacesEveryGrainInsideTheConeWithoutOverlap) {
  const InitialGrains g = pour_grains({kPour}, {0.02, 0.02, 0.012});
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

/// How much of the grains lies in layers `apart` (1: all).
double layered(const InitialGrains& g, double apart) {
  std::complex<double> sum = 0;
  for (const Vec3& x : g.x) sum += std::polar(1.0, 2 * std::numbers::pi * x.y / apart);
  return std::abs(sum) / static_cast<double>(g.size());
}

/// Tells if grains in the box of the loose bed overlap each other or the floor.
bool has_overlaps(const InitialGrains& g) {
  for (std::size_t a = 0; a < g.size(); ++a) {
    if (g.x[a].y < g.diameter[a] / 2) return true;
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3 d = g.x[a] - g.x[b];
      const Vec3 nearest{std::remainder(d.x, 0.006), d.y, std::remainder(d.z, 0.004)};
      if (norm(nearest) < (g.diameter[a] + g.diameter[b]) / 2) return true;
    }
  }
  return false;
}

TEST(Pour, ALooseBedHasNoLayersAndNoOverlap) {
  const std::array<double, 3> size{0.006, 0.02, 0.004};
  HeapConfig bed{.shape = HeapShape::bed, .sizes = kSizes};
  const double layer = 1.01 * 2.5e-4 * std::sqrt(2.0 / 3);
  EXPECT_GT(layered(pour_grains({bed}, size), layer), 0.99);
  bed.spacing = 4;
  EXPECT_FALSE(has_overlaps(pour_grains({bed}, {0.006, 0.2, 0.004})));
  bed.spacing = 1.5;
  const InitialGrains g = pour_grains({bed}, size);
  ASSERT_EQ(g.size(), 1000u);
  // Of a displacement that is uniform in a sphere of a quarter of the distance, over the waves.
  const double k = 2 * std::numbers::pi / (1.5 * layer) * 0.25 * 1.01 * 2.5e-4;
  const double exact = 3 * (std::sin(k) - k * std::cos(k)) / (k * k * k);
  EXPECT_NEAR(layered(g, 1.5 * layer), exact, 0.03);
  EXPECT_FALSE(has_overlaps(g));
}

/// No grains overlap, also not through the periodic sides.
TEST(Pour, ABedCoversTheFloorEvenly) {
  const std::array<double, 3> size{0.006, 0.01, 0.004};
  const InitialGrains g =
      pour_grains({{.shape = HeapShape::bed, .sizes = kSizes, .drop_height = 0.001}}, size);
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

// A lattice of every site of the floor took 25 s and 8 GB.
TEST(Pour, FewGrainsOfAWideFootTakeAsLittle) {
  const std::array<double, 3> domain{0.05, 0.02, 0.05};
  for (const std::int64_t n : {10, 3000}) {
    const std::vector<SizeClass> sizes = {{2e-6, n}};
    for (const HeapShape shape : {HeapShape::bed, HeapShape::ridge, HeapShape::cone}) {
      HeapConfig heap;
      heap.shape = shape;
      heap.centre = {0.025, 0.025};
      heap.radius = 0.02;
      heap.sizes = sizes;
      const InitialGrains grains = pour_grains({heap}, domain);
      ASSERT_EQ(grains.size(), static_cast<std::size_t>(n));
      EXPECT_NO_THROW(check_overlaps(grains, {0.05, 0.05}, 1e-6, "heap"));
      double from_crest = 0, z_low = 1, z_high = 0, x_low = 1, x_high = 0;
      for (const Vec3& x : grains.x) {
        EXPECT_NEAR(x.y, 1.01e-6, 1e-8) << "a single layer";
        from_crest = std::max(from_crest,
                              std::hypot(x.x - 0.025, shape == HeapShape::cone ? x.z - 0.025 : 0));
        x_low = std::min(x_low, x.x), x_high = std::max(x_high, x.x);
        z_low = std::min(z_low, x.z), z_high = std::max(z_high, x.z);
      }
      // Grains of a bed and a ridge lie anywhere, those of a cone in a hexagonal patch around its
      // axis.
      const bool bed = shape == HeapShape::bed, cone = shape == HeapShape::cone;
      const double spread = n == 10 ? 0.02 : 0.045;
      const double patch = std::sqrt(static_cast<double>(n) * std::sqrt(0.75) / std::numbers::pi);
      EXPECT_TRUE(cone || z_high - z_low > spread) << z_high - z_low;
      EXPECT_TRUE(!bed || x_high - x_low > spread) << x_high - x_low;
      EXPECT_LT(std::abs(from_crest - (bed ? from_crest : cone ? 2.02e-6 * patch : 1e-6)), 1.6e-6);
    }
  }
}

TEST(Pour, TheSeedDecides) {
  const std::array<double, 3> size{0.02, 0.02, 0.012};
  const InitialGrains a = pour_grains({kPour}, size), b = pour_grains({kPour}, size);
  EXPECT_EQ(a.diameter, b.diameter);
  EXPECT_EQ(a.x[500].x, b.x[500].x);
  HeapConfig other = kPour;
  other.seed = 4;
  EXPECT_NE(pour_grains({other}, size).diameter, a.diameter);
}

TEST(Pour, RefusesAConeThatDoesNotFit) {
  EXPECT_THROW(pour_grains({kPour}, {0.02, 0.001, 0.012}), std::runtime_error);
  HeapConfig edge = kPour;
  edge.centre[0] = 0.001;
  EXPECT_THROW(pour_grains({edge}, {0.02, 0.02, 0.012}), std::runtime_error);
}

// --- Grains of a file in the domain of a case.

/// Position of a grain of a file in a domain of 0.1 x 0.02 x 0.05 m; throws as make_initial_state.
Vec3 placed(const Vec3& x, GrainBoundaryX sides) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "grains.csv";
  std::ofstream(path) << "id,diameter,x,y,z\n1,2e-4," << x.x << ',' << x.y << ',' << x.z << '\n';
  Config config;
  config.size = {0.1, 0.02, 0.05};
  config.grains.emplace().boundary_x = sides;
  const SystemState state = make_initial_state(config, {.fluid = {}, .grains = path});
  const auto kin = host_copy(state.grains->kin);
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

/// The message about grains at random places in a cube of `length`, periodic along x and z if that
/// is asked for, and the deepest overlap by all pairs.
std::pair<std::string, double> crowd(int n, double length, double most, bool periodic = false) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, length), size(1e-4, 3e-4);
  InitialGrains grains;
  for (int g = 0; g < n; ++g)
    grains.add(100 + g, size(random), {place(random), place(random), place(random)}, {}, {});
  const PeriodicBox box = periodic ? PeriodicBox{length, length} : PeriodicBox{};
  double deepest = 0;
  for (std::size_t a = 0; a < grains.size(); ++a) {
    for (std::size_t b = a + 1; b < grains.size(); ++b) {
      const double mean = (grains.diameter[a] + grains.diameter[b]) / 2;
      deepest = std::max(deepest, 1 - norm(box.nearest_image(grains.x[a] - grains.x[b])) / mean);
    }
  }
  return {message_of([&] { check_overlaps(grains, box, most, "heap.csv"); }), deepest};
}

TEST(InitialState, TheDeepestOverlapOfAllPairsIsTold) {
  for (const double length : {3e-3, 6e-3, 1e-2}) {
    const auto [told, deepest] = crowd(400, length, 0.01);
    ASSERT_GT(deepest, 0.01);
    EXPECT_TRUE(contains(told, fmt::format("overlap by {:.3g} %", 100 * deepest))) << told;
    EXPECT_EQ(crowd(400, length, deepest + 1e-9).first, "");
    EXPECT_NE(crowd(400, length, deepest - 1e-9).first, "");
  }
}

TEST(InitialState, OverlapsThroughPeriodicSidesCountOnce) {
  for (const double length : {1e-3, 1.2e-3, 2e-3}) {
    const auto [told, deepest] = crowd(100, length, 0.01, true);
    EXPECT_TRUE(contains(told, fmt::format("overlap by {:.3g} %", 100 * deepest))) << told;
    EXPECT_EQ(crowd(100, length, deepest + 1e-9, true).first, "");
    EXPECT_FALSE(contains(crowd(100, length, deepest - 1e-9, true).first, "pairs"));
  }
  // Overlaps through each side and each of the four edges.
  for (const Vec3& x : {Vec3{0, 1, 5}, Vec3{5, 1, 0}, Vec3{0, 1, 0}, Vec3{0, 1, 10}}) {
    InitialGrains grains;
    const Vec3 other{x.x == 0 ? 10.0 : x.x, 1, x.z == 0 ? 10.0 : x.z == 10 ? 0 : x.z};
    grains.add(1, 2e-4, 1e-3 * x, {}, {});
    grains.add(2, 2e-4, 1e-3 * other, {}, {});
    EXPECT_TRUE(contains(message_of([&] {
                           check_overlaps(grains, {1e-2, 1e-2}, 0.1, "heap.csv");
                         }),
                         "grains 1 and 2 overlap by 100 %"));
    EXPECT_EQ(message_of([&] { check_overlaps(grains, {}, 0.1, "heap.csv"); }), "");
  }
}

TEST(InitialState, OverlapsAreToldWithTheirGrains) {
  InitialGrains grains;
  grains.add(7, 2e-4, {1e-3, 1e-3, 1e-3}, {}, {});
  grains.add(9, 2e-4, {1e-3, 1e-3, 1.15e-3}, {}, {});
  EXPECT_EQ(message_of([&] { check_overlaps(grains, {}, 0.1, "heap.csv"); }),
            "heap.csv: grains 7 and 9 overlap by 25 % of their mean diameter at the start, which "
            "is more than grains.max_overlap, 10 %");
  EXPECT_EQ(message_of([&] { check_overlaps(grains, {}, 0.3, "heap.csv"); }), "");
}

}  // namespace
}  // namespace barchan
