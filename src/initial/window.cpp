#include "src/initial/window.hpp"

#include <algorithm>

#include "src/base/errors.hpp"

namespace barchan {

namespace {

constexpr double kMostOverlap = 0.01;  // across the seam, over the smaller diameter

void cut_outside(const Config& config, InitialGrains& grains) {
  const auto [x0, z0] = *config.initial.window;
  std::vector<bool> inside;
  for (Vec3& x : grains.x) {
    x = x - Vec3{x0, 0, z0};
    inside.push_back(x.x >= 0 && x.x < config.size[0] && x.z >= 0 && x.z < config.size[2] &&
                     x.y <= config.size[1]);
  }
  grains.keep(inside);
}

/// Grains within a largest diameter of a side where the box repeats.
std::vector<std::size_t> at_seams(const PeriodicBox& box, const InitialGrains& grains) {
  std::vector<std::size_t> found;
  const double r_max = std::ranges::max(grains.diameter) / 2;
  const auto near = [r_max](double x, double length) {
    return length > 0 && (x < 2 * r_max || x > length - 2 * r_max);
  };
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (near(grains.x[g].x, box.lx) || near(grains.x[g].z, box.lz)) found.push_back(g);
  return found;
}

/// Of each two that overlap across a seam the later one goes: side by side they do not.
void cut_at_seams(const PeriodicBox& box, InitialGrains& grains) {
  const std::vector<std::size_t> at_seam = at_seams(box, grains);
  std::vector<bool> stays(grains.size(), true);
  for (std::size_t a = 0; a < at_seam.size(); ++a) {
    const std::size_t g = at_seam[a];
    for (std::size_t b = 0; b < a && stays[g]; ++b) {
      const std::size_t other = at_seam[b];
      if (!stays[other]) continue;
      const Vec3 apart = grains.x[g] - grains.x[other], nearest = box.nearest_image(apart);
      const double d = grains.diameter[g], d_other = grains.diameter[other];
      const bool touches = norm(nearest) < (d + d_other) / 2 - kMostOverlap * std::min(d, d_other);
      if (touches && norm(nearest) < norm(apart)) stays[g] = false;
    }
  }
  grains.keep(stays);
}

}  // namespace

void cut_to_window(const Config& config, const PeriodicBox& box, InitialGrains& grains) {
  cut_outside(config, grains);
  if (grains.size() == 0) throw InputError("initial.window: no grains lie in it");
  cut_at_seams(box, grains);
}

}  // namespace barchan
