#include "src/initial/crater.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "src/base/errors.hpp"
#include "src/case/config.hpp"

namespace barchan {
namespace {

double distance_from(const CraterConfig& crater, const Vec3& x) {
  return std::hypot(x.x - crater.centre[0], x.z - crater.centre[1]);
}

/// Mean height of the surface within the rim [m]: the highest grain's top in each of the squares,
/// as wide as the largest grain, that hold any. 0 without grains.
double surface_within(const CraterConfig& crater, const InitialGrains& grains) {
  const double width = std::ranges::max(grains.diameter);
  std::map<std::pair<int, int>, double> tops;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec3& x = grains.x[g];
    if (distance_from(crater, x) >= crater.radius) continue;
    const std::pair square(static_cast<int>(std::floor((x.x - crater.centre[0]) / width)),
                           static_cast<int>(std::floor((x.z - crater.centre[1]) / width)));
    double& top = tops[square];
    top = std::max(top, x.y + grains.diameter[g] / 2);
  }
  double sum = 0;
  for (const auto& [square, top] : tops) sum += top;
  return tops.empty() ? 0 : sum / static_cast<double>(tops.size());
}

void cut(const CraterConfig& crater, double surface, InitialGrains& grains) {
  std::vector<bool> kept;
  for (const Vec3& x : grains.x) {
    const double r = distance_from(crater, x) / crater.radius;
    kept.push_back(r >= 1 || x.y <= surface - crater.depth * (1 - r * r));
  }
  grains.keep(kept);
}

}  // namespace

void cut_craters(const std::vector<CraterConfig>& craters, InitialGrains& grains) {
  for (std::size_t n = 0; n < craters.size(); ++n) {
    const CraterConfig& crater = craters[n];
    const double surface = grains.size() == 0 ? 0 : surface_within(crater, grains);
    if (surface == 0)
      throw InputError(fmt::format("initial.crater.{}: no grains lie within its rim", n + 1));
    if (crater.depth > surface) {
      throw InputError(
          fmt::format("initial.crater.{}: depth = {:g}: must be at most {:.4g} m, the height of "
                      "the grains there",
                      n + 1, crater.depth, surface));
    }
    cut(crater, surface, grains);
  }
}

}  // namespace barchan
