#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "src/config/config.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

namespace {

/// A uniform number in [0, 1) from 53 bits: the same on every platform, unlike the library's.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

struct Site {
  Vec3 x;         // relative to the centre of the foot [m]
  double height;  // of the smallest cone through it [m]
};

/// Sites below `top` inside the foot, by the height of the cone that just holds them.
std::vector<Site> cone_sites(double radius, double spacing, double top) {
  const double layer = spacing * std::sqrt(2.0 / 3.0), row = spacing * std::sqrt(3.0) / 2;
  const int n_x = static_cast<int>(radius / spacing) + 2, n_z = static_cast<int>(radius / row) + 2;
  std::vector<Site> sites;
  for (int j = 0; spacing / 2 + layer * j < top; ++j) {
    for (int k = -n_z; k <= n_z; ++k) {
      for (int i = -n_x; i <= n_x; ++i) {
        const Vec3 x{spacing * (i + 0.5 * ((k + j) & 1)), spacing / 2 + layer * j,
                     row * (k + (j & 1) / 3.0)};
        const double r = std::hypot(x.x, x.z);
        if (r < radius) sites.push_back({x, x.y / (1 - r / radius)});
      }
    }
  }
  return sites;
}

std::vector<double> shuffled_diameters(const std::vector<SizeClass>& sizes,
                                       std::mt19937_64& generator) {
  std::vector<double> d;
  for (const SizeClass& size : sizes)
    d.insert(d.end(), static_cast<std::size_t>(size.count), size.diameter);
  for (std::size_t n = d.size(); n > 1; --n) {
    std::swap(d[n - 1], d[static_cast<std::size_t>(uniform(generator) * static_cast<double>(n))]);
  }
  return d;
}

}  // namespace

InitialGrains pour_grains(const PourConfig& pour, const std::vector<SizeClass>& sizes,
                          const std::array<double, 3>& domain) {
  std::mt19937_64 generator(pour.seed);
  const std::vector<double> diameter = shuffled_diameters(sizes, generator);
  const std::size_t n = diameter.size();
  const double spacing = 1.01 * *std::max_element(diameter.begin(), diameter.end());
  // A cone of height h holds about pi R^2 h / 3 / (spacing^3 / sqrt 2) sites.
  const double estimate = static_cast<double>(n) * spacing * spacing * spacing / std::sqrt(2.0) *
                          3 / (std::numbers::pi * pour.radius * pour.radius);
  std::vector<Site> sites;
  for (double top = 1.2 * estimate + 2 * spacing; sites.size() < n; top *= 1.5) {
    sites = cone_sites(pour.radius, spacing, top);
    std::erase_if(sites, [top](const Site& s) { return s.height > top; });
    if (top > 1e3 * domain[1]) break;
  }
  std::stable_sort(sites.begin(), sites.end(),
                   [](const Site& a, const Site& b) { return a.height < b.height; });
  const bool fits = sites.size() >= n &&
                    sites[n - 1].height + spacing / 2 + pour.drop_height < domain[1] &&
                    pour.centre[0] > pour.radius && pour.centre[0] + pour.radius < domain[0];
  if (!fits) {
    throw std::runtime_error(
        "the poured cone of " + std::to_string(n) +
        " grains does not fit in the domain: change initial.grains.pour.radius, "
        "its centre or domain.size");
  }
  InitialGrains grains;
  for (std::size_t g = 0; g < n; ++g) {
    const auto jitter = [&] { return 0.004 * (uniform(generator) - 0.5) * spacing; };
    const Vec3 x = sites[g].x;
    grains.add(static_cast<std::int64_t>(g) + 1, diameter[g],
               {pour.centre[0] + x.x + jitter(), pour.drop_height + x.y + jitter(),
                pour.centre[1] + x.z + jitter()});
  }
  return grains;
}

}  // namespace barchan
