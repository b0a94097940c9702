#include "src/diagnostics/dune_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace barchan {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

double to_period(double x, double length, bool periodic) {
  return periodic ? x - std::floor(x / length) * length : x;
}

/// Interval that starts empty.
struct Extent {
  double low = kInfinity, high = -kInfinity;
  void include(double a, double b) {
    low = std::min(low, a);
    high = std::max(high, b);
  }
  [[nodiscard]] double size() const { return high - low; }
};

/// Outline of the grains of a region, or of the high ones among them.
struct Outline {
  double left_tip = -kInfinity;   // most downstream edge beside the strip, z < Cz
  double right_tip = -kInfinity;  // most downstream edge beside the strip, z > Cz
  // extent in x of the grains on the centreline, by column of bins (ux)
  std::map<int, Extent> strip;
};

/// Sums and extents of one region; coordinates are unwrapped.
struct Region {
  DuneRecord record;
  int n_bins = 0;
  double crest_height = 0.0;  // height on the centreline
  double crest_weight = 0.0;  // sum of weights behind crest_x
  Extent x, z;                // extent of all grains
  Outline all, high;
};

struct DuneMeasurement {
  GrainCloud grains;
  DuneDomain domain;
  DuneCriteria criteria;
  HeightMap map{grains, domain, criteria};
  std::vector<Region> regions = std::vector<Region>(map.n_regions);
  std::vector<double> surface = std::vector<double>(map.bins.size());  // medians [m]

  Dunes run() {
    sum_grains();
    find_crests();
    collect_outlines();
    std::vector<int> dunes;  // the regions that are dunes, largest first
    for (int i = 0; i < map.n_regions; ++i) {
      if (regions[i].record.n_grains >= criteria.min_grains) dunes.push_back(i);
    }
    std::stable_sort(dunes.begin(), dunes.end(), [&](int a, int b) {
      return regions[a].record.volume > regions[b].record.volume;
    });
    Dunes found;
    std::vector<int> record_of_region(regions.size(), -1);
    for (const int region : dunes) {
      record_of_region[region] = static_cast<int>(found.records.size());
      found.records.push_back(finish(regions[region]));
      found.records.back().dune = record_of_region[region];
    }
    for (std::size_t p = 0; p < grains.size(); ++p) {
      const int region = map.region_of(p);
      found.of_grain.push_back(region < 0 ? -1 : record_of_region[region]);
    }
    return found;
  }

  /// Calls f(p, region, x, z) for each grain of a region, with its unwrapped centre.
  template <class F>
  void for_each_grain(const F& f) {
    for (std::size_t p = 0; p < grains.size(); ++p) {
      const int region = map.region_of(p);
      if (region < 0) continue;
      const auto [x, z] = map.unwrapped(grains, p);
      f(p, regions[region], x, z);
    }
  }
  /// Calls f(b, region, x, z) for each bin of a region, with its unwrapped centre.
  template <class F>
  void for_each_bin(const F& f) {
    for (std::size_t b = 0; b < map.bins.size(); ++b) {
      const HeightMap::Bin& bin = map.bins[b];
      if (bin.region < 0) continue;
      const auto [x, z] = map.unwrapped_centre(bin);
      f(b, regions[bin.region], x, z);
    }
  }
  [[nodiscard]] bool in_strip(double z, const Region& region) const {
    const double half_width = criteria.centreline_half_width * map.mean_diameter;
    return std::abs(z - region.record.cz) < half_width;
  }

  /// Sums up number, volume, centroid and extents of each region.
  void sum_grains() {
    for_each_grain([&](std::size_t p, Region& region, double x, double z) {
      const double d = grains[p].d, volume = std::numbers::pi / 6.0 * d * d * d;
      DuneRecord& record = region.record;
      ++record.n_grains;
      record.volume += volume;
      record.cx += volume * x;
      record.cy += volume * grains[p].x.y;
      record.cz += volume * z;
      record.flux += volume * grains[p].u_x;
      region.x.include(x - 0.5 * d, x + 0.5 * d);
      region.z.include(z - 0.5 * d, z + 0.5 * d);
    });
    for_each_bin([](std::size_t, Region& region, double, double) { ++region.n_bins; });
    const double bin_area = map.bin_x * map.bin_z;
    for (Region& region : regions) {
      region.record.flux /= region.n_bins * bin_area;
      region.record.cx /= region.record.volume;
      region.record.cy /= region.record.volume;
      region.record.cz /= region.record.volume;
    }
  }

  /// Finds H over the region, and crest_x on the centreline. The strip may miss every bin centre
  /// only when the dune has no sand there, and crest_x then stays at Cx.
  void find_crests() {
    for_each_bin([&](std::size_t b, Region& region, double, double z) {
      surface[b] = map.smoothed_surface(map.bins[b]);
      region.record.h = std::max(region.record.h, surface[b]);
      if (in_strip(z, region)) region.crest_height = std::max(region.crest_height, surface[b]);
    });
    for_each_bin([&](std::size_t b, Region& region, double x, double z) {
      const double band = std::max(0.05 * region.crest_height, 0.5 * map.mean_diameter);
      const double weight = surface[b] - (region.crest_height - band);
      if (weight <= 0.0 || !in_strip(z, region)) return;
      region.crest_weight += weight;
      region.record.crest_x += weight * x;
    });
    for (Region& region : regions) {
      DuneRecord& record = region.record;
      record.crest_x = region.crest_weight > 0.0 ? record.crest_x / region.crest_weight : record.cx;
    }
  }

  /// Collects the grains in the strip along the centreline, and the most downstream edge on either
  /// side of it.
  void collect_outlines() {
    for_each_grain([&](std::size_t p, Region& region, double x, double z) {
      const int bin = map.bin_of_grain[p];
      const auto add_to = [&](Outline& outline) {
        const double radius = 0.5 * grains[p].d;
        if (in_strip(z, region)) {
          outline.strip[map.bins[bin].ux].include(x - radius, x + radius);
        } else {
          double& tip = z < region.record.cz ? outline.left_tip : outline.right_tip;
          tip = std::max(tip, x + radius);
        }
      };
      add_to(region.all);
      if (surface[bin] >= criteria.horn_height * map.mean_diameter) add_to(region.high);
    });
  }

  /// Centreline from toe to lee foot: the columns around the crest that hold sand without a gap.
  /// The strip must not be empty.
  [[nodiscard]] Extent centreline(const std::map<int, Extent>& strip, double crest_x) const {
    const double column = crest_x / map.bin_x;
    const auto from_crest = [&](const auto& entry) { return std::abs(entry.first + 0.5 - column); };
    const auto crest = std::ranges::min_element(strip, {}, from_crest);
    Extent line;
    for (const int step : {-1, 1}) {
      for (int i = crest->first; strip.contains(i); i += step)
        line.include(strip.at(i).low, strip.at(i).high);
    }
    return line;
  }

  [[nodiscard]] DuneRecord finish(const Region& region) const {
    DuneRecord record = region.record;
    if (region.all.strip.empty()) {
      record.l = region.x.size();
    } else {
      const Extent line = centreline(region.all.strip, record.crest_x);
      record.l = line.size();
      record.horn_left = std::max(0.0, region.all.left_tip - line.high);
      record.horn_right = std::max(0.0, region.all.right_tip - line.high);
    }
    if (!region.high.strip.empty()) {
      const double lee_foot = centreline(region.high.strip, record.crest_x).high;
      record.horn_left_2d = std::max(0.0, region.high.left_tip - lee_foot);
      record.horn_right_2d = std::max(0.0, region.high.right_tip - lee_foot);
    }
    record.w = region.z.size();
    if (domain.periodic_z) record.w = std::min(record.w, domain.length_z);
    if (domain.periodic_x) record.l = std::min(record.l, domain.length_x);
    record.cx = to_period(record.cx, domain.length_x, domain.periodic_x);
    record.cz = to_period(record.cz, domain.length_z, domain.periodic_z);
    record.crest_x = to_period(record.crest_x, domain.length_x, domain.periodic_x);
    record.celerity = kNotKnown;
    return record;
  }
};

}  // namespace

Dunes find_dunes(GrainCloud grains, const DuneDomain& domain, const DuneCriteria& criteria) {
  return DuneMeasurement{grains, domain, criteria}.run();
}

}  // namespace barchan
