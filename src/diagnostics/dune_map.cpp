#include "src/diagnostics/dune_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace barchan {
namespace {

std::uint64_t key_of(int ix, int iz) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(ix)) << 32) |
         static_cast<std::uint32_t>(iz);
}

int wrap(int i, int period) {
  if (period == 0) return i;
  const int r = i % period;
  return r < 0 ? r + period : r;
}

}  // namespace

HeightMap::HeightMap(GrainCloud grains, const DuneDomain& domain, const DuneCriteria& criteria) {
  if (!(domain.length_x > 0.0 && domain.length_z > 0.0))
    throw std::invalid_argument("dune map: the domain has no extent");
  if (grains.empty()) return;
  choose_bins(grains, domain, criteria.bin);
  fill(grains);
  label_regions(mark_dune_bins(criteria));
}

void HeightMap::choose_bins(GrainCloud grains, const DuneDomain& domain, double bin_size) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const GrainSample& grain : grains) {
    if (!std::isfinite(grain.d) || grain.d <= 0.0) continue;
    sum += grain.d;
    ++n;
  }
  if (n == 0) throw std::invalid_argument("dune map: no grain has a positive diameter");
  mean_diameter = sum / static_cast<double>(n);
  const double target = bin_size * mean_diameter;
  const int nx = static_cast<int>(std::clamp(domain.length_x / target, 1.0, 1e9));
  const int nz = static_cast<int>(std::clamp(domain.length_z / target, 1.0, 1e9));
  bin_x = domain.length_x / nx;
  bin_z = domain.length_z / nz;
  period_x_ = domain.periodic_x ? nx : 0;
  period_z_ = domain.periodic_z ? nz : 0;
}

void HeightMap::fill(GrainCloud grains) {
  const double bin_area = bin_x * bin_z;
  const double farthest = 1e9;  // in bins: keeps the conversion to int defined
  bin_of_grain.assign(grains.size(), -1);
  for (std::size_t p = 0; p < grains.size(); ++p) {
    const double d = grains[p].d, top = grains[p].x.y + 0.5 * d;
    const double x = grains[p].x.x / bin_x, z = grains[p].x.z / bin_z;
    if (!(std::abs(x) < farthest && std::abs(z) < farthest && std::isfinite(top))) continue;
    const int ix = static_cast<int>(std::floor(x)), iz = static_cast<int>(std::floor(z));
    const int wx = wrap(ix, period_x_), wz = wrap(iz, period_z_);
    const auto [entry, is_new] = index_.try_emplace(key_of(wx, wz), static_cast<int>(bins.size()));
    if (is_new) bins.push_back({.ix = wx, .iz = wz, .ux = wx, .uz = wz});
    Bin& bin = bins[entry->second];
    bin.cover += 0.25 * std::numbers::pi * d * d / bin_area;
    bin.surface = std::max(bin.surface, top);
    bin_of_grain[p] = entry->second;
  }
}

HeightMap::Position HeightMap::unwrapped(GrainCloud grains, std::size_t p) const {
  const Bin& bin = bins[bin_of_grain[p]];
  const double x = grains[p].x.x, z = grains[p].x.z;
  return {.x = bin.ux * bin_x + x - std::floor(x / bin_x) * bin_x,
          .z = bin.uz * bin_z + z - std::floor(z / bin_z) * bin_z};
}

std::array<HeightMap::Neighbour, 8> HeightMap::neighbours(const Bin& bin) const {
  std::array<Neighbour, 8> result{};
  std::size_t n = 0;
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dz == 0) continue;
      const auto entry =
          index_.find(key_of(wrap(bin.ix + dx, period_x_), wrap(bin.iz + dz, period_z_)));
      result[n++] = {.bin = entry == index_.end() ? -1 : entry->second, .dx = dx, .dz = dz};
    }
  }
  return result;
}

/// Core bins, and the rim grown from them breadth first, one bin per step, up to the reach.
std::vector<char> HeightMap::mark_dune_bins(const DuneCriteria& criteria) const {
  std::vector<char> marked(bins.size(), 0);
  std::vector<int> front;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    if (bins[b].cover < criteria.core_cover) continue;
    marked[b] = 1;
    front.push_back(static_cast<int>(b));
  }
  const double reach = criteria.rim_reach * mean_diameter / std::max(bin_x, bin_z);
  const int steps = static_cast<int>(std::ceil(reach));
  for (int step = 0; step < steps && !front.empty(); ++step) {
    std::vector<int> next;
    for (const int b : front) {
      for (const Neighbour& n : neighbours(bins[b])) {
        if (n.bin < 0 || marked[n.bin] || bins[n.bin].cover < criteria.rim_cover) continue;
        marked[n.bin] = 1;
        next.push_back(n.bin);
      }
    }
    front.swap(next);
  }
  return marked;
}

/// Connected components; each bin takes its unwrapped position from the bin it was reached from.
void HeightMap::label_regions(const std::vector<char>& in_dune) {
  std::vector<int> queue;
  for (std::size_t seed = 0; seed < bins.size(); ++seed) {
    if (!in_dune[seed] || bins[seed].region >= 0) continue;
    bins[seed].region = n_regions;
    queue.assign(1, static_cast<int>(seed));
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Bin from = bins[queue[head]];
      for (const Neighbour& n : neighbours(from)) {
        if (n.bin < 0 || !in_dune[n.bin] || bins[n.bin].region >= 0) continue;
        Bin& to = bins[n.bin];
        to.region = n_regions;
        to.ux = from.ux + n.dx;
        to.uz = from.uz + n.dz;
        queue.push_back(n.bin);
      }
    }
    ++n_regions;
  }
}

double HeightMap::smoothed_surface(const Bin& bin) const {
  std::array<double, 9> heights{bin.surface};
  std::size_t n = 1;
  for (const Neighbour& neighbour : neighbours(bin)) {
    const bool same = neighbour.bin >= 0 && bins[neighbour.bin].region == bin.region;
    heights[n++] = same ? bins[neighbour.bin].surface : 0.0;
  }
  std::nth_element(heights.begin(), heights.begin() + 4, heights.end());
  return heights[4];
}

}  // namespace barchan
