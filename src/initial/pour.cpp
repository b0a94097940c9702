#include "src/initial/pour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <stdexcept>

#include "kernels/bodies/body.hpp"
#include "src/case/derived.hpp"
#include "src/case/heaps.hpp"

namespace barchan {

namespace {

/// A uniform number in [0, 1) from 53 bits: the same on every platform, unlike the library's.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

/// A random place in a sphere about the origin.
Vec3 within_sphere(double radius, std::mt19937_64& generator) {
  const auto side = [&] { return 2 * uniform(generator) - 1; };
  for (;;) {
    const Vec3 x{side(), side(), side()};
    if (norm(x) < 1) return radius * x;
  }
}

template <class Item>
void shuffle(std::vector<Item>& items, std::mt19937_64& generator) {
  for (std::size_t n = items.size(); n > 1; --n) {
    const double at = uniform(generator) * static_cast<double>(n);
    std::swap(items[n - 1], items[static_cast<std::size_t>(at)]);
  }
}

/// Shape of a heap: a cone over its foot, a ridge across the channel, a bed over the floor.
struct Heap {
  HeapShape shape;
  Vec3 centre;            // centre of the foot [m]
  double half_x, half_z;  // half sizes of the foot [m]: both the radius of a cone
  Bodies bodies;          // bodies in which nothing is poured

  Heap(const HeapConfig& heap, const std::array<double, 3>& domain, const Bodies& solids,
       double ground)
      : shape(heap.shape),
        centre{heap.centre[0], ground + heap.drop_height, heap.centre[1]},
        half_x(heap.radius),
        half_z(heap.radius),
        bodies(solids) {
    if (shape == HeapShape::cone) return;
    half_z = domain[2] / 2, centre.z = half_z;
    if (shape == HeapShape::bed) half_x = domain[0] / 2, centre.x = half_x;
  }

  /// Height of the smallest heap of this shape through x, seen from the centre [m]; negative
  /// outside the foot.
  double height_through(const Vec3& x, double spacing) const {
    if (shape == HeapShape::cone) return below_slope(std::hypot(x.x, x.z), x.y);
    if (std::abs(x.z) + spacing / 2 > half_z) return -1;
    if (shape == HeapShape::ridge) return below_slope(std::abs(x.x), x.y);
    return std::abs(x.x) + spacing / 2 <= half_x ? x.y : -1;
  }

  /// Tells if a grain of this diameter at x, seen from the centre, overlaps a body.
  bool in_body(const Vec3& x, double diameter) const {
    return bodies.n > 0 && bodies.nearest(centre + x).surface.distance < diameter / 2;
  }

  /// Half the width of the heap of height `top` at the height y [m]; for a bed, that of the foot.
  double half_x_at(double y, double top) const {
    return shape == HeapShape::bed ? half_x : half_x * std::max(0.0, 1 - y / top);
  }
  double half_z_at(double y, double top) const {
    return shape == HeapShape::cone ? half_x_at(y, top) : half_z;
  }
  /// Approximate number of sites of the heap of height `top`.
  double count_below(double top, double spacing) const {
    const double foot =
        shape == HeapShape::cone ? std::numbers::pi * half_x * half_x : 4 * half_x * half_z;
    const double mean = shape == HeapShape::cone ? 1.0 / 3 : shape == HeapShape::ridge ? 0.5 : 1;
    return mean * foot * top * std::numbers::sqrt2 / std::pow(spacing, 3);
  }

  double below_slope(double r, double y) const { return r < half_x ? y / (1 - r / half_x) : -1; }
};

struct Site {
  Vec3 x;         // relative to the centre of the foot [m]
  double height;  // height of the smallest heap through it [m]
};

/// Lattice of possible places of grains: a close packing, stretched along the floor for a thin bed
/// or ridge.
struct Lattice {
  double spacing;
  double stretch_x = 1, stretch_z = 1;
  double layer() const { return spacing * std::sqrt(2.0 / 3.0); }
  double x() const { return stretch_x * spacing; }
  double z() const { return stretch_z * (spacing * std::sqrt(3.0) / 2); }
};

/// Number of columns of a lattice on either side of the middle of a foot, and a few more.
int columns(double half, double apart) { return static_cast<int>(half / apart) + 2; }

/// Sites of the lattice that lie in the heap of height `top`.
std::vector<Site> sites_below(double top, const Heap& heap, const Lattice& lattice) {
  const double spacing = lattice.spacing;
  std::vector<Site> sites;
  for (int j = 0; spacing / 2 + lattice.layer() * j < top; ++j) {
    const double y = spacing / 2 + lattice.layer() * j;
    const int n_x = columns(heap.half_x_at(y, top), lattice.x());
    const int n_z = columns(heap.half_z_at(y, top), lattice.z());
    for (int k = -n_z; k <= n_z; ++k) {
      for (int i = -n_x; i <= n_x; ++i) {
        const Vec3 x{lattice.x() * (i + 0.5 * ((k + j) & 1)), y, lattice.z() * (k + (j & 1) / 3.0)};
        const double height = heap.height_through(x, spacing);
        if (height >= 0 && height <= top && !heap.in_body(x, spacing)) sites.push_back({x, height});
      }
    }
  }
  return sites;
}

/// Sites for n grains that are few for their foot: from its middle outward over a cone or a ridge,
/// anywhere on the floor of a bed. In each case there are some more than n, and not all sites.
std::vector<Site> sites_of_thin(std::size_t n, const Heap& heap, double spacing, double highest) {
  constexpr double kMore = 16;  // sites for a grain
  const double wanted = kMore * static_cast<double>(n);
  Lattice lattice{spacing};
  const bool bed = heap.shape == HeapShape::bed;
  const double along = 2 * heap.half_x / lattice.x(), across = 2 * heap.half_z / lattice.z();
  const double rows = std::min(across, bed ? std::max(std::sqrt(wanted), wanted / along) : wanted);
  if (heap.shape != HeapShape::cone) lattice.stretch_z = across / rows;
  if (bed) lattice.stretch_x = std::max(1.0, along * rows / wanted);
  std::vector<Site> sites;
  double reach = 2 * spacing;  // reach of the lowest layer from the middle
  for (double top = 0; sites.size() < n && top <= highest; reach *= 1.4) {
    const bool sloped = !bed && reach < 0.9 * heap.half_x;
    top = sloped ? spacing / 2 / (1 - reach / heap.half_x) : std::max(spacing, 1.5 * top);
    sites = sites_below(top, heap, lattice);
  }
  return sites;
}

/// Sizes and kinds, one for each grain, in random order.
std::vector<SizeClass> shuffled(const std::vector<SizeClass>& sizes, std::mt19937_64& generator) {
  std::vector<SizeClass> grains;
  for (const SizeClass& size : sizes)
    grains.insert(grains.end(), static_cast<std::size_t>(size.count), size);
  shuffle(grains, generator);
  return grains;
}

/// The n lowest sites of a heap, from its axis outward and upward.
std::vector<Site> lowest_sites(const HeapConfig& config, const Heap& heap, std::size_t n,
                               const std::array<double, 3>& domain, std::mt19937_64& generator) {
  const double spacing = poured_spacing(config);
  const double highest = 1e3 * domain[1];
  const double first = 1.2 * poured_height(config, domain) + 2 * spacing;
  std::vector<Site> sites;
  if (heap.count_below(first, spacing) > 1e6 + 30 * static_cast<double>(n)) {
    sites = sites_of_thin(n, heap, spacing, highest);
  } else {
    for (double top = first; sites.size() < n && top <= highest; top *= 1.5)
      sites = sites_below(top, heap, {spacing});
  }
  if (heap.shape != HeapShape::cone) shuffle(sites, generator);  // the last layer has gaps anywhere
  std::stable_sort(sites.begin(), sites.end(),
                   [](const Site& a, const Site& b) { return a.height < b.height; });
  const bool fits = sites.size() >= n &&
                    heap.centre.y + sites[n - 1].height + spacing / 2 < domain[1] &&
                    heap.centre.x >= heap.half_x && heap.centre.x + heap.half_x <= domain[0];
  if (fits) return sites;
  throw std::runtime_error(
      fmt::format("the poured heap{} of {} grains does not fit in the domain{}: change its radius, "
                  "its centre, its spacing or domain.size",
                  config.name.empty() ? "" : fmt::format(" \"{}\"", config.name), n,
                  heap.bodies.n > 0 ? " beside the bodies" : ""));
}

/// Adds the grains of a heap.
void add_heap(const HeapConfig& config, const Heap& heap, const std::array<double, 3>& domain,
              InitialGrains& grains) {
  std::mt19937_64 generator(config.seed);
  const std::vector<SizeClass> poured = shuffled(config.sizes, generator);
  const double closest = poured_spacing(config.sizes), gap = poured_spacing(config) - closest;
  const auto sites = lowest_sites(config, heap, poured.size(), domain, generator);
  for (std::size_t g = 0; g < poured.size(); ++g) {
    const auto jitter = [&] { return 0.004 * (uniform(generator) - 0.5) * closest; };
    Vec3 x = heap.centre + sites[g].x;
    x = Vec3{x.x + jitter(), x.y + jitter(), x.z + jitter()};
    if (gap > 0) x += within_sphere(gap / 2, generator);
    grains.add(static_cast<std::int64_t>(grains.size()) + 1, poured[g].diameter, x);
    grains.kind.push_back(static_cast<std::uint8_t>(poured[g].kind));
  }
}

/// Diameter of the sphere around a poured grain [m].
double width_of(const std::vector<SizeClass>& sizes, const InitialGrains& grains, std::size_t g) {
  const auto size = std::ranges::find(sizes, grains.kind_of(g), &SizeClass::kind);
  return (size != sizes.end() ? size->wide : 1) * grains.diameter[g];
}

/// Moves the grains from entry `begin` on together.
void pack(const HeapConfig& config, const Heap& heap, std::size_t begin, InitialGrains& grains) {
  // Density of the packing: 0.64 of the volume, as in a heap. Displaced so far, a third of the 12
  // neighbours touch.
  constexpr double lattice = 1.05, displacement = 0.1;
  const double d = mean_diameter(config.sizes), closer = lattice * d / poured_spacing(config);
  std::mt19937_64 generator(config.seed);
  const auto displaced = [&] { return displacement * d * (2 * uniform(generator) - 1); };
  for (std::size_t g = begin; g < grains.size(); ++g) {
    Vec3 x = heap.centre + closer * (grains.x[g] - heap.centre);
    x = x + Vec3{displaced(), displaced(), displaced()};
    const double width = width_of(config.sizes, grains, g);
    grains.x[g] = {x.x, std::max(x.y, width / 2), x.z};
    if (!heap.in_body(grains.x[g] - heap.centre, width)) continue;
    const ToSurface at = heap.bodies.nearest(grains.x[g]).surface;
    grains.x[g] += (width / 2 - at.distance) * at.normal;
  }
}

InitialGrains pour(const std::vector<HeapConfig>& heaps, const std::array<double, 3>& domain,
                   const Bodies& bodies, bool packed) {
  InitialGrains grains;
  double ground = 0;  // top of the beds [m]
  for (std::size_t n = 0; n < heaps.size(); ++n) {
    const std::size_t begin = grains.size();
    HeapConfig config = heaps[n];
    if (packed) config.spacing = 1;
    const Heap heap(config, domain, bodies, ground);
    add_heap(config, heap, domain, grains);
    if (packed) pack(config, heap, begin, grains);
    if (heaps.size() > 1) {
      grains.heap.resize(grains.size(), static_cast<std::uint8_t>(n));
      grains.heap_names.push_back(heaps[n].name);
    }
    if (heap.shape != HeapShape::bed) continue;
    const double wide = std::ranges::max(config.sizes, {}, &SizeClass::wide).wide;
    for (std::size_t g = begin; g < grains.size(); ++g)
      ground = std::max(ground, grains.x[g].y + wide * grains.diameter[g] / 2);
  }
  if (std::ranges::count(grains.kind, 0) == std::ssize(grains.kind)) grains.kind.clear();
  return grains;
}

}  // namespace

InitialGrains pour_grains(const std::vector<HeapConfig>& heaps, const std::array<double, 3>& domain,
                          const Bodies& bodies) {
  return pour(heaps, domain, bodies, false);
}

InitialGrains pour_grains(const std::vector<HeapConfig>& heaps,
                          const std::array<double, 3>& domain) {
  return pour(heaps, domain, {}, false);
}

InitialGrains packed_grains(const std::vector<HeapConfig>& heaps,
                            const std::array<double, 3>& domain, const Bodies& bodies) {
  return pour(heaps, domain, bodies, true);
}

InitialGrains packed_grains(const std::vector<HeapConfig>& heaps,
                            const std::array<double, 3>& domain) {
  return pour(heaps, domain, {}, true);
}

}  // namespace barchan
