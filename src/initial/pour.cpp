#include "src/initial/pour.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "src/config/derived.hpp"

namespace barchan {

namespace {

/// A uniform number in [0, 1) from 53 bits: the same on every platform, unlike the library's.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

template <class Item>
void shuffle(std::vector<Item>& items, std::mt19937_64& generator) {
  for (std::size_t n = items.size(); n > 1; --n) {
    const double at = uniform(generator) * static_cast<double>(n);
    std::swap(items[n - 1], items[static_cast<std::size_t>(at)]);
  }
}

/// Where grains are poured: a cone over its foot, or a bed over the floor.
struct Heap {
  PourShape shape;
  Vec3 centre;            // of the foot [m]
  double half_x, half_z;  // of the foot [m]: both the radius of a cone

  Heap(const PourConfig& pour, const std::array<double, 3>& domain)
      : shape(pour.shape),
        centre{pour.centre[0], pour.drop_height, pour.centre[1]},
        half_x(pour.radius),
        half_z(pour.radius) {
    if (shape == PourShape::cone) return;
    half_x = domain[0] / 2, half_z = domain[2] / 2;
    centre.x = half_x, centre.z = half_z;
  }

  /// Of the smallest cone or bed through x, seen from the centre [m]; negative outside the foot.
  double height_through(const Vec3& x, double spacing) const {
    if (shape == PourShape::bed) {
      const bool inside =
          std::abs(x.x) + spacing / 2 <= half_x && std::abs(x.z) + spacing / 2 <= half_z;
      return inside ? x.y : -1;
    }
    const double r = std::hypot(x.x, x.z);
    return r < half_x ? x.y / (1 - r / half_x) : -1;
  }
};

struct Site {
  Vec3 x;         // relative to the centre of the foot [m]
  double height;  // of the smallest heap through it [m]
};

/// Sites of the lattice that lie in the heap of height `top`.
std::vector<Site> sites_below(double top, const Heap& heap, double spacing) {
  const double layer = spacing * std::sqrt(2.0 / 3.0), row = spacing * std::sqrt(3.0) / 2;
  const int n_x = static_cast<int>(heap.half_x / spacing) + 2,
            n_z = static_cast<int>(heap.half_z / row) + 2;
  std::vector<Site> sites;
  for (int j = 0; spacing / 2 + layer * j < top; ++j) {
    for (int k = -n_z; k <= n_z; ++k) {
      for (int i = -n_x; i <= n_x; ++i) {
        const Vec3 x{spacing * (i + 0.5 * ((k + j) & 1)), spacing / 2 + layer * j,
                     row * (k + (j & 1) / 3.0)};
        const double height = heap.height_through(x, spacing);
        if (height >= 0 && height <= top) sites.push_back({x, height});
      }
    }
  }
  return sites;
}

/// A size and kind for each grain, in random order.
std::vector<SizeClass> shuffled(const std::vector<SizeClass>& sizes, std::mt19937_64& generator) {
  std::vector<SizeClass> grains;
  for (const SizeClass& size : sizes)
    grains.insert(grains.end(), static_cast<std::size_t>(size.count), size);
  shuffle(grains, generator);
  return grains;
}

}  // namespace

InitialGrains pour_grains(const PourConfig& pour, const std::vector<SizeClass>& sizes,
                          const std::array<double, 3>& domain) {
  std::mt19937_64 generator(pour.seed);
  const std::vector<SizeClass> poured = shuffled(sizes, generator);
  const std::size_t n = poured.size();
  const double spacing = poured_spacing(sizes);
  const Heap heap(pour, domain);
  std::vector<Site> sites;
  const double estimate = poured_height(pour, domain, static_cast<double>(n), spacing);
  for (double top = 1.2 * estimate + 2 * spacing; sites.size() < n; top *= 1.5) {
    sites = sites_below(top, heap, spacing);
    if (top > 1e3 * domain[1]) break;
  }
  if (pour.shape == PourShape::bed) shuffle(sites, generator);  // its last layer has gaps anywhere
  std::stable_sort(sites.begin(), sites.end(),
                   [](const Site& a, const Site& b) { return a.height < b.height; });
  const bool fits = sites.size() >= n &&
                    sites[n - 1].height + spacing / 2 + pour.drop_height < domain[1] &&
                    heap.centre.x >= heap.half_x && heap.centre.x + heap.half_x <= domain[0];
  if (!fits) {
    throw std::runtime_error(
        "the poured heap of " + std::to_string(n) +
        " grains does not fit in the domain: change initial.grains.pour.radius, "
        "its centre or domain.size");
  }
  InitialGrains grains;
  for (std::size_t g = 0; g < n; ++g) {
    const auto jitter = [&] { return 0.004 * (uniform(generator) - 0.5) * spacing; };
    const Vec3 x = heap.centre + sites[g].x;
    grains.add(static_cast<std::int64_t>(g) + 1, poured[g].diameter,
               {x.x + jitter(), x.y + jitter(), x.z + jitter()});
    grains.kind.push_back(static_cast<std::uint8_t>(poured[g].kind));
  }
  if (std::ranges::none_of(sizes, &SizeClass::kind)) grains.kind.clear();
  return grains;
}

InitialGrains packed_grains(const PourConfig& pour, const std::vector<SizeClass>& sizes,
                            const std::array<double, 3>& domain) {
  // As dense as a heap, 0.64 of the volume. Displaced so far, a third of the 12 neighbours touch.
  constexpr double lattice = 1.05, displacement = 0.1;
  InitialGrains grains = pour_grains(pour, sizes, domain);
  const double d = mean_diameter(sizes), closer = lattice * d / poured_spacing(sizes);
  const Heap heap(pour, domain);
  std::mt19937_64 generator(pour.seed);
  const auto displaced = [&] { return displacement * d * (2 * uniform(generator) - 1); };
  for (std::size_t g = 0; g < grains.size(); ++g) {
    Vec3 x = heap.centre + closer * (grains.x[g] - heap.centre);
    x = x + Vec3{displaced(), displaced(), displaced()};
    grains.x[g] = {x.x, std::max(x.y, grains.diameter[g] / 2), x.z};
  }
  return grains;
}

}  // namespace barchan
