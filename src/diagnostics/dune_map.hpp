#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Grain as the search for dunes needs it.
struct GrainSample {
  Vec3 x;            ///< centre [m]
  double d = 0.0;    ///< diameter [m]
  double u_x = 0.0;  ///< streamwise velocity [m/s]
  double heap = -1;  ///< number of the heap it came from; -1: from none
};
using GrainCloud = std::span<const GrainSample>;

/// Horizontal extent of the domain; the wall that carries the dunes is y = 0.
struct DuneDomain {
  double length_x = 0.0;  ///< along the flow [m]
  double length_z = 0.0;  ///< across the flow [m]
  bool periodic_x = false;
  bool periodic_z = true;

  /// Differences of coordinates, to the nearest image [m].
  [[nodiscard]] double nearest_x(double dx) const { return nearest(dx, length_x, periodic_x); }
  [[nodiscard]] double nearest_z(double dz) const { return nearest(dz, length_z, periodic_z); }

 private:
  static double nearest(double difference, double length, bool periodic) {
    return periodic ? difference - std::round(difference / length) * length : difference;
  }
};

/// Criteria for a dune. Lengths are in mean grain diameters, covers are the summed cross-sections
/// of the grains of a bin over the area of the bin.
struct DuneCriteria {
  double bin = 2.5;         ///< side of a bin (stretched so that bins fill the domain)
  double core_cover = 1.2;  ///< no monolayer reaches this (hexagonal packing: 0.907)
  double rim_cover = 0.3;   ///< about a third of a dense monolayer
  double rim_reach = 12.0;  ///< how far the rim goes out from a core; a thin foot fits in
  int min_grains = 100;     ///< smaller regions are not dunes
  double centreline_half_width = 3.0;  ///< of the strip in which length and crest are measured
  double horn_height = 2.0;            ///< least height of a horn: above streaks of grains
  double celerity_window = 1.0;        ///< [s]
};

/// Map of the surface height h(x, z), and the regions of it that are dunes.
///
/// Height. A bin holds h = max(y + d/2) [m] over the grains whose centres it contains, and their
/// cover. Only bins that hold grains exist, so the cost is that of the grains, not of the domain,
/// and a grain far downstream costs one bin.
///
/// Regions. Two thresholds with hysteresis, as Canny (IEEE Trans. Pattern Anal. Mach. Intell. 8,
/// 679, 1986) links edges: *core* bins have a cover that a single layer of grains cannot reach;
/// *rim* bins are covered by a fair part of a monolayer and join within a fixed reach of a core, so
/// that the thin foot of a dune and the tips of its horns belong to it. Loose grains and sparse
/// carpets of bed load reach neither threshold: they neither enlarge a dune nor bridge two. A
/// region is a set of core and rim bins connected over their eight neighbours (across periodic
/// boundaries). It is the outline that one would draw around the bedform in a top view image, which
/// is how Alvarez & Franklin (Phys. Rev. E 96, 062906, 2017) measure W, L and the horns.
struct HeightMap {
  struct Bin {
    int ix = 0, iz = 0;    ///< position in the domain
    int ux = 0, uz = 0;    ///< position in the domain, unwrapped so that a region is in one piece
    double cover = 0.0;    ///< [-]
    double surface = 0.0;  ///< h [m]
    int region = -1;       ///< -1: not part of a dune
  };

  /// Throws std::invalid_argument if the domain has no extent or no grain has a size.
  HeightMap(GrainCloud grains, const DuneDomain& domain, const DuneCriteria& criteria);

  double mean_diameter = 0.0, bin_x = 0.0, bin_z = 0.0;  ///< [m]
  std::vector<Bin> bins;
  /// Index into bins for each grain; -1 for a grain whose position or size is not a number.
  std::vector<int> bin_of_grain;
  int n_regions = 0;

  /// Region that grain p lies in, -1: in none.
  [[nodiscard]] int region_of(std::size_t p) const {
    return bin_of_grain[p] < 0 ? -1 : bins[bin_of_grain[p]].region;
  }

  /// Median of h over the bin and its eight neighbours [m], bins outside the region counting as
  /// zero: a grain that flies over the dune does not show in it.
  [[nodiscard]] double smoothed_surface(const Bin& bin) const;

  /// Coordinates of the centre of grain p (which must have a bin) with periodic images undone, so
  /// that the grains of one region lie side by side [m].
  struct Position {
    double x, z;
  };
  [[nodiscard]] Position unwrapped(GrainCloud grains, std::size_t p) const;
  [[nodiscard]] Position unwrapped_centre(const Bin& bin) const {
    return {.x = (bin.ux + 0.5) * bin_x, .z = (bin.uz + 0.5) * bin_z};
  }

 private:
  struct Neighbour {
    int bin;     // index, -1: no grains there
    int dx, dz;  // offset in bins
  };

  void choose_bins(GrainCloud grains, const DuneDomain& domain, double bin_size);
  void fill(GrainCloud grains);
  [[nodiscard]] std::array<Neighbour, 8> neighbours(const Bin& bin) const;
  [[nodiscard]] std::vector<char> mark_dune_bins(const DuneCriteria& criteria) const;
  void label_regions(const std::vector<char>& in_dune);

  int period_x_ = 0, period_z_ = 0;  // in bins; 0: not periodic
  std::unordered_map<std::uint64_t, int> index_;
};

}  // namespace barchan
