#include "src/initial/window.hpp"

#include <algorithm>

#include "src/base/errors.hpp"
#include "src/initial/initial_state.hpp"

namespace barchan {

namespace {

constexpr double kMostOverlap = 0.01;  // across the seam or with a wall, over the smaller diameter

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

/// Spheres that grains are made of, with the entry of the grain of each.
struct Spheres {
  InitialGrains of;
  std::vector<std::size_t> grain;
};
Spheres spheres_in(const Config& config, const InitialGrains& grains) {
  Spheres spheres{.of = config.grains ? spheres_at_start(grains, config) : grains, .grain = {}};
  std::size_t next = 0;
  for (const std::int64_t id : spheres.of.id) {
    if (spheres.of.clump.empty() || member_of_id(id) == 0) ++next;
    spheres.grain.push_back(next - 1);
  }
  return spheres;
}

/// Clumps that reach into a wall go. Spheres that do are left to the checks of the run.
void cut_in_walls(const Config& config, const Spheres& spheres, std::vector<bool>& stays) {
  if (spheres.of.clump.empty()) return;
  const bool wall_x = config.grains->boundary_x == GrainBoundaryX::wall,
             wall_z = config.grains->boundary_z == GrainBoundaryZ::wall;
  for (std::size_t s = 0; s < spheres.of.size(); ++s) {
    const double reach = (0.5 - kMostOverlap) * spheres.of.diameter[s];
    const auto within = [reach](double x, double length) {
      return x >= reach && x <= length - reach;
    };
    const Vec3& x = spheres.of.x[s];
    if ((wall_x && !within(x.x, config.size[0])) || (wall_z && !within(x.z, config.size[2])))
      stays[spheres.grain[s]] = false;
  }
}

/// Spheres that may meet others across a side where the box repeats. Those of a clump may lie past
/// it, as far as they are from the centre.
std::vector<std::size_t> at_seams(const PeriodicBox& box, const InitialGrains& spheres) {
  std::vector<std::size_t> found;
  double reach = 0;
  for (std::size_t s = 0; s < spheres.clump.size(); ++s)
    reach = std::max(reach, norm(spheres.x[s] - spheres.clump[s].x));
  reach += std::ranges::max(spheres.diameter);
  const auto near = [reach](double x, double length) {
    return length > 0 && (x < reach || x > length - reach);
  };
  for (std::size_t s = 0; s < spheres.size(); ++s)
    if (near(spheres.x[s].x, box.lx) || near(spheres.x[s].z, box.lz)) found.push_back(s);
  return found;
}

/// Of each two grains that overlap across a seam the later one goes: side by side they do not.
void cut_at_seams(const PeriodicBox& box, const Spheres& spheres, std::vector<bool>& stays) {
  const std::vector<std::size_t> at_seam = at_seams(box, spheres.of);
  for (std::size_t a = 0; a < at_seam.size(); ++a) {
    const std::size_t s = at_seam[a];
    for (std::size_t b = 0; b < a && stays[spheres.grain[s]]; ++b) {
      const std::size_t other = at_seam[b];
      if (!stays[spheres.grain[other]]) continue;
      const Vec3 apart = spheres.of.x[s] - spheres.of.x[other], nearest = box.nearest_image(apart);
      const double d = spheres.of.diameter[s], d_other = spheres.of.diameter[other];
      const bool touches = norm(nearest) < (d + d_other) / 2 - kMostOverlap * std::min(d, d_other);
      if (touches && norm(nearest) < norm(apart)) stays[spheres.grain[s]] = false;
    }
  }
}

}  // namespace

void cut_to_window(const Config& config, const PeriodicBox& box, InitialGrains& grains) {
  cut_outside(config, grains);
  if (grains.size() == 0) throw InputError("initial.window: no grains lie in it");
  const Spheres spheres = spheres_in(config, grains);
  std::vector<bool> stays(grains.size(), true);
  cut_in_walls(config, spheres, stays);
  cut_at_seams(box, spheres, stays);
  grains.keep(stays);
}

}  // namespace barchan
