#include "src/case/heap_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/ranges.h>

#include "src/base/words.hpp"
#include "src/case/derived.hpp"
#include "src/case/heaps.hpp"
#include "src/grains/kinds.hpp"
#include "src/toml/names.hpp"

namespace barchan {
namespace {

/// Dotted names of the keys of a heap: those of `pour`, or of the nth [[initial.heap]].
struct HeapKeys {
  std::string section;
  std::string operator()(const char* key) const { return section + "." + key; }
};

/// Checks that a heap lies in the domain along x and, unless it is a ridge, along z.
void check_place(const HeapConfig& heap, const HeapKeys& key, const std::array<double, 3>& domain,
                 Findings& found) {
  const bool cone = heap.shape == HeapShape::cone;
  for (const int axis : {0, 1}) {
    if (axis == 1 && !cone) return;
    const double extent = domain[axis == 0 ? 0 : 2];
    const double at = heap.centre[static_cast<std::size_t>(axis)];
    found.error_if(at - heap.radius < 0 || at + heap.radius > extent,
                   {key("radius"), key("centre"), "domain.size"},
                   "must keep the {} inside the domain; along {} it spans {:.4g} to {:.4g} m of "
                   "0 to {:.4g} m",
                   cone ? "cone" : "ridge", axis == 0 ? 'x' : 'z', at - heap.radius,
                   at + heap.radius, extent);
  }
}

/// Checks the shape of a heap; false if nothing is to be concluded from it.
bool check_shape(const HeapConfig& heap, const HeapKeys& key, const std::array<double, 3>& domain,
                 Findings& found) {
  const bool bed = heap.shape == HeapShape::bed;
  found.error_if(bed && heap.radius > 0, {key("radius"), key("shape")},
                 "contradicts shape = \"bed\", which covers the floor");
  found.error_if(bed && !heap.name.empty() && heap.centre != HeapConfig{}.centre,
                 {key("centre"), key("shape")},  // of `pour` told by check_effects
                 "must be absent with shape = \"bed\", which covers the floor");
  if (found.error_if(!bed && heap.radius == 0, {key("radius"), key("shape")},
                     "must be above 0 for a {}", heap.shape == HeapShape::cone ? "cone" : "ridge"))
    return false;
  if (!bed) check_place(heap, key, domain, found);
  return true;
}

/// Distance of the feet of two heaps in the plane of the floor [m], through periodic sides as well,
/// less a grain; negative: they overlap.
double gap(const HeapConfig& a, const HeapConfig& b, const Config& c) {
  const auto distance = [](double from, double to, double period, bool periodic) {
    return std::abs(periodic ? std::remainder(from - to, period) : from - to);
  };
  const bool ridge = a.shape == HeapShape::ridge || b.shape == HeapShape::ridge;
  const double x = distance(a.centre[0], b.centre[0], c.size[0], is_periodic_x(c));
  const double z = distance(a.centre[1], b.centre[1], c.size[2],
                            c.grains->boundary_z == GrainBoundaryZ::periodic);
  const double grain = 0.5 * (poured_spacing(a) + poured_spacing(b));
  return (ridge ? x : std::hypot(x, z)) - a.radius - b.radius - grain;
}

/// Checks the nth heap against those before it.
void check_apart(const std::vector<HeapConfig>& heaps, std::size_t n, const HeapKeys& key,
                 const Config& c, Findings& found) {
  const HeapConfig& heap = heaps[n];
  for (std::size_t before = 0; before < n; ++before) {
    const HeapConfig& other = heaps[before];
    if (other.shape == HeapShape::bed) continue;  // this one stands on it
    if (found.error_if(heap.shape == HeapShape::bed, {key("shape")},
                       "must stand before \"{}\": a bed lies under the heaps after it", other.name))
      return;
    const double apart = gap(heap, other, c);
    found.error_if(apart < 0, {key("centre"), key("radius")},
                   "must be at least {:.3g} m farther from \"{}\": the two heaps overlap", -apart,
                   other.name);
  }
}

/// Checks the kind of a heap; false if it is not known, or if the heap has sizes and does not say
/// of which of several kinds.
bool check_kind(const Config& c, std::size_t n, Findings& found) {
  const HeapConfig& heap = c.initial.heaps[n];
  const HeapKeys key{fmt::format("initial.heap.{}", n + 1)};
  const std::vector<std::string> names = names_of_kinds(*c.grains);
  if (heap.kind.empty())
    return !found.error_if(!heap.sizes.empty() && c.grains->kinds.size() > 1,
                           {key("sizes"), key("kind"), "grains.kind"},
                           "must come with a kind, \"{}\"", fmt::join(names, "\" or \""));
  return !found.error_if(kind_of_name(*c.grains, heap.kind) < 0, {key("kind"), "grains.kind"},
                         "must be the name of a [[grains.kind]]; \"{}\" is none{}", heap.kind,
                         did_you_mean(nearest(heap.kind, names)));
}

void check_names(const std::vector<HeapConfig>& heaps, Findings& found) {
  for (std::size_t n = 0; n < heaps.size(); ++n) {
    const HeapKeys key{fmt::format("initial.heap.{}", n + 1)};
    check_name(heaps[n].name, {key("name")}, found);
    const auto same = [&](const HeapConfig& other) { return other.name == heaps[n].name; };
    found.error_if(std::find_if(heaps.begin(), heaps.begin() + static_cast<std::ptrdiff_t>(n),
                                same) != heaps.begin() + static_cast<std::ptrdiff_t>(n),
                   {key("name")}, "must be another one: \"{}\" is the name of an earlier heap",
                   heaps[n].name);
  }
}

/// Checks that the rims of craters lie in the domain.
void check_craters(const Config& c, Findings& found) {
  for (std::size_t n = 0; n < c.initial.craters.size(); ++n) {
    const CraterConfig& crater = c.initial.craters[n];
    const HeapKeys key{fmt::format("initial.crater.{}", n + 1)};
    const auto [x, z] = crater.centre;
    const double r = crater.radius;
    found.error_if(x - r < 0 || x + r > c.size[0] || z - r < 0 || z + r > c.size[2],
                   {key("radius"), key("centre"), "domain.size"},
                   "must keep the rim inside the domain, 0 to {:.4g} m along x and 0 to {:.4g} m "
                   "along z",
                   c.size[0], c.size[2]);
  }
}

}  // namespace

void check_heaps(const Config& c, Findings& found) {
  check_craters(c, found);
  const std::vector<HeapConfig> heaps = poured_heaps(c);
  if (heaps.empty()) return;
  const bool pour = c.initial.pour.has_value();
  const auto keys_of = [&](std::size_t n) {
    return HeapKeys{pour ? "initial.grains.pour" : fmt::format("initial.heap.{}", n + 1)};
  };
  if (!pour) check_names(heaps, found);
  bool known = true;
  for (std::size_t n = 0; n < c.initial.heaps.size(); ++n) known = check_kind(c, n, found) && known;
  if (!known) return;
  const std::vector<SizeClass> sizes = sizes_of(heaps);
  constexpr int kMost = std::numeric_limits<int>::max();  // what a run can number
  found.error_if(!pour && count_of(sizes) > kMost, {"initial.heap"},
                 "must be of at most {} grains in all", kMost);
  found.error_if(sizes.empty(), {"grains.sizes", "initial.grains"},
                 "must say which grains to pour: sizes = [[2e-4, 3000]] are 3,000 of 0.2 mm");
  found.error_if(c.grains->frozen, {"grains.frozen", pour ? "initial.grains" : "initial.heap"},
                 "contradicts pour: grains could not settle");
  bool shaped = true;
  for (std::size_t n = 0; n < heaps.size(); ++n)
    shaped = check_shape(heaps[n], keys_of(n), c.size, found) && shaped;
  if (!shaped || sizes.empty()) return;
  if (poured_spacing(sizes) >= c.size[1]) return;  // told by check_grain_sizes
  double highest = 0;
  for (std::size_t n = 0; n < heaps.size(); ++n) {
    const HeapKeys key = keys_of(n);
    check_apart(heaps, n, key, c, found);
    const auto after = heaps.begin() + static_cast<std::ptrdiff_t>(n) + 1;
    const double top = poured_top({heaps.begin(), after}, c.size);
    found.error_if(top > c.size[1] && top > highest,
                   {key("radius"), key("drop_height"), "domain.size"},
                   "must be larger: the heap would reach about {:.3g} m, above the domain{}", top,
                   heaps[n].spacing > 1 ? "; or take a smaller spacing" : "");
    highest = std::max(highest, top);
  }
}

}  // namespace barchan
