#include "src/case/shape_checks.hpp"

#include <algorithm>
#include <cmath>

#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"

namespace barchan {
namespace {

/// Checks that nothing is said of a clump where grains are spheres.
void check_absent(const ShapeConfig& shape, const std::string& section, Findings& found) {
  const std::string of = section + ".shape", message = "must be absent unless shape = \"clump\"";
  found.error_if(!shape.spheres.empty(), {section + ".spheres", of}, "{}", message);
  found.error_if(shape.clump.has_value(), {section + ".clump", of}, "{}", message);
}

void check_shape(const ShapeConfig& shape, const std::string& section, Findings& found) {
  if (shape.shape == GrainShape::sphere) return check_absent(shape, section, found);
  const std::string of = section + ".shape", spheres = section + ".spheres",
                    clump = section + ".clump";
  const bool both = !shape.spheres.empty() && shape.clump;
  if (found.error_if(both, {spheres, clump}, "contradicts clump: give one of the two")) return;
  const std::vector<ClumpSphere> all = spheres_of(shape);
  if (found.error_if(all.empty(), {of, spheres, clump},
                     "must come with its spheres = [[x, y, z, radius], ...], or with the name of "
                     "a clump"))
    return;
  if (found.error_if(all.size() > kMostSpheres, {spheres, of},
                     "must be at most {} spheres; there are {}", kMostSpheres, all.size()))
    return;
  const std::string problem = problem_of(shape);
  found.error_if(!problem.empty(), {spheres, of}, "must be a whole: {}", problem);
}

}  // namespace

void check_shapes(const Config& c, Findings& found) {
  const GrainConfig& grains = *c.grains;
  const std::size_t before = found.all.size();
  const std::vector<KindConfig> kinds = all_kinds(grains);
  if (!grains.kinds.empty() &&
      !found.error_if(grains.shape.shape != GrainShape::sphere, {"grains.shape", "grains.kind"},
                      "must be absent: every [[grains.kind]] has its own"))
    check_absent(grains.shape, "grains", found);
  for (std::size_t k = 0; k < kinds.size(); ++k)
    check_shape(kinds[k].shape, section_of_kind(grains, k), found);
  if (found.all.size() > before || !has_clumps(grains)) return;
  const auto first =
      std::ranges::find_if(kinds, [](const KindConfig& kind) { return is_clump(kind.shape); });
  const std::string key =
      section_of_kind(grains, static_cast<std::size_t>(first - kinds.begin())) + ".shape";
  found.error_if(c.fluid && c.coupling.scheme == CouplingScheme::resolved, {key, "coupling.scheme"},
                 "must be \"sphere\" with scheme = \"resolved\", whose markers lie on spheres");
}

void check_clump_sizes(const Config& c, const std::vector<SizeClass>& sizes, Findings& found) {
  const GrainConfig& grains = *c.grains;
  if (!has_clumps(grains)) return;
  const double widest = widths_of(grains, sizes).most;
  const double least = 2 * (widest + grains.skin);
  found.error_if((grains.boundary_z == GrainBoundaryZ::periodic && c.size[2] < least) ||
                     (is_periodic_x(grains) && c.size[0] < least),
                 {"domain.size", "grains.sizes", "grains.shape"},
                 "must be at least {:.3g} m in a periodic direction: a clump would meet its own "
                 "image",
                 least);
  const double narrowest = *std::min_element(c.size.begin(), c.size.end());
  found.error_if(widest >= narrowest, {"domain.size", "grains.sizes", "grains.shape"},
                 "must be above {:.4g} m, the width of the largest clump", widest);
}

void check_smallest_sphere(const Config& c, const KindNumbers& kind, const std::string& who,
                           Findings& found) {
  if (kind.spheres == 1) return;
  constexpr double most = 0.5;  // radii
  const auto [gx, gy, gz] = c.grains->gravity;
  const double fall = std::sqrt(2 * std::hypot(gx, gy, gz) * kind.d_mean);
  const double speed = kind.impact_speed > 0 ? kind.impact_speed : fall;
  found.error_if(true_grain_step(c.time) * speed > most * kind.r_least,
                 {"time.grain_step", "grains.spheres", "grains.sizes"},
                 "must be at most {:.3g} s, or the smallest sphere of {}, of radius {:.3g} m, goes "
                 "more than half its radius in it at {:.3g} m/s; leave out spheres as small as "
                 "this",
                 most * kind.r_least / speed, who, kind.r_least, speed);
}

}  // namespace barchan
