#include "src/initial/overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "kernels/grains/body_contact.hpp"
#include "src/base/errors.hpp"

namespace barchan {
namespace {

/// Number of a grain, of which an entry may be one sphere of many.
std::int64_t number_of(const InitialGrains& grains, std::size_t entry) {
  return grains.clump.empty() ? grains.id[entry] : clump_of_id(grains.id[entry]);
}

/// Grain, or its image beyond the upper side of a periodic direction, with the slab across x that
/// its centre lies in; slabs are one largest diameter wide.
struct InSlab {
  std::int64_t slab;
  double z;
  std::size_t grain;
  bool beyond_x, beyond_z;
};

struct Deepest {
  double overlap = 0;  // over the mean diameter
  std::size_t a = 0, b = 0;
  std::size_t count = 0;  // number of pairs beyond the limit
};

class Search {
 public:
  Search(const InitialGrains& grains, const PeriodicBox& box)
      : grains_(grains), box_(box), width_(std::ranges::max(grains.diameter)) {
    for (std::size_t g = 0; g < grains.size(); ++g) {
      const Vec3 at = box.wrap(grains.x[g]);  // spheres of a clump may lie past a seam
      const bool x = box.lx > 0 && at.x<width_, z = box.lz> 0 && at.z < width_;
      for (const bool beyond_x : {false, true})
        for (const bool beyond_z : {false, true})
          if ((x || !beyond_x) && (z || !beyond_z)) add(g, at, beyond_x, beyond_z);
    }
    std::ranges::sort(order_, {}, key);
  }

  /// Deepest overlap of all pairs of one slab and the next that are near each other in z.
  Deepest deepest(double most) const {
    Deepest found;
    for (auto at = order_.begin(); at != order_.end(); ++at) {
      for (auto other = at + 1; other != order_.end() && is_near(*at, *other); ++other)
        look_at(*at, *other, most, found);
      const auto next = std::pair(at->slab + 1, at->z - width_);
      for (auto other = std::ranges::lower_bound(order_, next, {}, key);
           other != order_.end() && other->slab == at->slab + 1 && other->z <= at->z + width_;
           ++other)
        look_at(*at, *other, most, found);
    }
    return found;
  }

 private:
  bool of_one_clump(std::size_t a, std::size_t b) const {
    return !grains_.clump.empty() && clump_of_id(grains_.id[a]) == clump_of_id(grains_.id[b]);
  }

  static std::pair<std::int64_t, double> key(const InSlab& one) { return {one.slab, one.z}; }

  bool is_near(const InSlab& a, const InSlab& b) const {
    return a.slab == b.slab && b.z <= a.z + width_;
  }

  void add(std::size_t g, const Vec3& at, bool beyond_x, bool beyond_z) {
    const double x = at.x + (beyond_x ? box_.lx : 0), z = at.z + (beyond_z ? box_.lz : 0);
    order_.push_back({static_cast<std::int64_t>(std::floor(x / width_)), z, g, beyond_x, beyond_z});
  }

  void look_at(const InSlab& one, const InSlab& other, double most, Deepest& found) const {
    const bool known = (one.beyond_x && other.beyond_x) || (one.beyond_z && other.beyond_z);
    const std::size_t a = one.grain, b = other.grain;
    if (known || a == b || of_one_clump(a, b)) return;
    const double mean = 0.5 * (grains_.diameter[a] + grains_.diameter[b]);
    const double apart = norm(box_.nearest_image(grains_.x[a] - grains_.x[b]));
    const double overlap = 1 - apart / mean;
    if (overlap > most) ++found.count;
    if (overlap > found.overlap) found = {overlap, a, b, found.count};
  }

  const InitialGrains& grains_;
  PeriodicBox box_;
  double width_;
  std::vector<InSlab> order_;
};

/// Tells if a grain overlaps a body wherever along z the feed puts it.
bool in_bodies_everywhere(const FeedConfig& feed, double lz, double r, const Bodies& bodies) {
  auto [from, to] = feed.across;
  if (from == to) to = from + lz;
  const int n = static_cast<int>(std::clamp(std::ceil((to - from) / (r / 4)), 1.0, 1e5));
  const double between = (to - from) / n;
  for (int k = 0; k <= n; ++k) {
    const Vec3 x{feed.x + r, feed.height + r, from + k * between};
    if (!(deepest_in(bodies, x, r) > between / 2)) return false;  // nor are those beside it
  }
  return true;
}

}  // namespace

void check_overlaps(const InitialGrains& grains, const PeriodicBox& box, double most,
                    const std::string& source) {
  const Deepest found = Search(grains, box).deepest(most);
  if (found.overlap <= most) return;
  const auto [first, second] =
      std::minmax({number_of(grains, found.a), number_of(grains, found.b)});
  throw InputError(fmt::format(
      "{}: grains {} and {} overlap by {:.3g} % of their mean diameter at the start, which is more "
      "than grains.max_overlap, {:.3g} %{}",
      source, first, second, 100 * found.overlap, 100 * most,
      found.count > 1 ? fmt::format("; {} pairs do", found.count) : ""));
}

void check_outside_bodies(const InitialGrains& grains, const GrainsCase& config,
                          const std::string& source) {
  const Bodies& bodies = config.bodies;
  const double most = config.grains.frozen ? 0.5 : std::min(config.grains.max_overlap, 0.5);
  for (int b = 0; b < bodies.n; ++b) {
    std::set<std::int64_t> inside;
    std::size_t deepest = 0;
    double overlap = 0;
    for (std::size_t g = 0; g < grains.size(); ++g) {
      const double in = 0.5 - bodies.body[b].distance(grains.x[g]) / grains.diameter[g];
      if (in > most) inside.insert(number_of(grains, g));
      if (in > overlap) overlap = in, deepest = g;
    }
    if (inside.empty()) continue;
    const Vec3& x = grains.x[deepest];
    throw InputError(fmt::format(
        "{}: {} in body \"{}\" by more than {:.3g} % of the diameter{}, the deepest grain {} at "
        "({:.6g}, {:.6g}, {:.6g}) m by {:.3g} %: take out the grains there, or move the body "
        "(body.{}.centre, body.{}.base)",
        source, inside.size() == 1 ? "a grain lies" : fmt::format("{} grains lie", inside.size()),
        config.body_names[static_cast<std::size_t>(b)], 100 * most,
        config.grains.frozen ? "" : " (grains.max_overlap)", number_of(grains, deepest), x.x, x.y,
        x.z, 100 * overlap, b + 1, b + 1));
  }
}

void check_feed_places(const GrainsCase& config, const Widths& widths) {
  if (config.bodies.n == 0 || !config.grains.feed) return;
  if (config.grains.boundary_x == GrainBoundaryX::follow) return;  // its places move
  const FeedConfig& feed = *config.grains.feed;
  for (const double width : {widths.least, widths.most})
    if (!in_bodies_everywhere(feed, config.size[2], width / 2, config.bodies)) return;
  throw InputError(fmt::format(
      "[grains.feed] x = {:.6g}, height = {:.6g}: no grain could come in: all across the stream a "
      "body is in its place; move the one or the other (grains.feed.across, body.1.centre)",
      feed.x, feed.height));
}

}  // namespace barchan
