// Polar averages of forces about a dune, where the force field is known.
#include "src/diagnostics/force_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/base/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

constexpr double d = 2e-4;

/// A cone of 6 mm radius at (x, z) and a force on each grain.
struct Heap {
  std::vector<GrainSample> grains;
  std::vector<Vec3> force;

  Heap(double x, double z, const DuneDomain& domain) {
    for (int i = -30; i <= 30; ++i) {
      for (int k = -30; k <= 30; ++k) {
        const double height = 2e-3 - std::hypot(i * d, k * d) / 3;
        for (int j = 0; j * d < height; ++j) {
          const double zz = z + k * d;
          const double wrapped = zz - std::floor(zz / domain.length_z) * domain.length_z;
          grains.push_back({{x + i * d, (j + 0.5) * d, wrapped}, d});
          // F_x grows downstream, F_z points outwards.
          force.push_back({1e-7 + 1e-4 * i * d, -3e-8, k > 0 ? 2e-8 : (k < 0 ? -2e-8 : 0)});
        }
      }
    }
  }
};

void expect_known(const ForceMap& map, double samples) {
  double n = 0;
  for (std::size_t b = 0; b < map.bins().size(); ++b) {
    const ForceMap::Bin& bin = map.bins()[b];
    const std::size_t a = b / ForceMap::n_radii, r = b % ForceMap::n_radii;
    n += bin.n;
    if (bin.n == 0 || r < 2) continue;
    const Vec3 mean = (1 / bin.n) * bin.force;
    const double phi = (static_cast<double>(a) + 0.5) * 10 * std::numbers::pi / 180;
    const double x = (static_cast<double>(r) + 0.5) * map.radius_step() * std::cos(phi);
    EXPECT_NEAR(mean.x, 1e-7 + 1e-4 * x, 1e-4 * 0.7 * map.radius_step()) << a << ' ' << r;
    EXPECT_NEAR(mean.y, -3e-8, 1e-15);
    // Left of the centreline (phi below 180 degrees) is z < Cz; lines along it hold zeros.
    if (a % 18 > 0 && a % 18 < 17) {
      EXPECT_NEAR(mean.z, phi < std::numbers::pi ? -2e-8 : 2e-8, 1e-15) << a << ' ' << r;
    }
  }
  EXPECT_EQ(n, samples);
}

TEST(ForceMap, MeansOfAKnownForceAnywhereInTheChannel) {
  const DuneDomain domain{.length_x = 0.1, .length_z = 0.04};
  for (const double z : {0.02, 0.001, 0.0391}) {  // the last two lie across the seam
    const Heap heap(0.03, z, domain);
    ForceMap map(domain);
    map.sample(0.5, heap.grains, heap.force);
    map.sample(0.5, heap.grains, heap.force);
    EXPECT_NEAR(map.radius_step(), 2.5 * d, 1e-15);
    expect_known(map, 2.0 * static_cast<double>(heap.grains.size()));
  }
}

TEST(ForceMap, NothingWithoutADune) {
  const TemporaryFolder folder;
  ForceMap map({.length_x = 0.1, .length_z = 0.04});
  map.sample(0.5, {}, {});
  map.write(folder / "force_map.csv");
  EXPECT_FALSE(std::filesystem::exists(folder / "force_map.csv"));
}

TEST(ForceMap, TableHoldsTheMeans) {
  const TemporaryFolder folder;
  const DuneDomain domain{.length_x = 0.1, .length_z = 0.04};
  const Heap heap(0.03, 0.02, domain);
  ForceMap map(domain);
  map.sample(0.5, heap.grains, heap.force);
  map.write(folder / "force_map.csv");
  const std::string text = read_text(folder / "force_map.csv");
  EXPECT_NE(text.find("\n0.001,0.0015,0,10,"), std::string::npos);
  EXPECT_TRUE(text.starts_with("r_min,r_max,phi_min,phi_max,n,F_x,F_y,F_z,t_start,t_end\n0"));
}

}  // namespace
}  // namespace barchan
