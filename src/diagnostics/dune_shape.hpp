#pragma once

#include <cstdint>
#include <vector>

#include "src/diagnostics/dune_map.hpp"

namespace barchan {

/// Shape of a dune at one time: a line of dune.csv (dune_table.hpp).
struct DuneRecord {
  double t = 0;           // [s]
  std::int64_t dune = 0;  // label; 0 is the largest
  std::int64_t n_grains = 0;
  double w = 0, l = 0, h = 0;            // width, length along the centreline, height [m]
  double cx = 0, cy = 0, cz = 0;         // centroid [m]
  double horn_left = 0, horn_right = 0;  // length [m]
  double crest_x = 0;                    // [m]
  double volume = 0;                     // [m^3]
  double celerity = 0;                   // [m/s]
  std::int64_t n_lost = 0;               // grains that left the domain so far
  double flux = 0;  // streamwise flux of grain volume, mean over the footprint [m^2/s]
  double horn_left_2d = 0, horn_right_2d = 0;  // length of what is two grains high [m]
};

/// Dunes of one time.
struct Dunes {
  std::vector<DuneRecord> records;
  std::vector<int> of_grain;  // index into records; -1: in no dune
};

/// Finds the dunes in the grains and measures each; records in descending order of volume, labelled
/// 0, 1, ... in that order; celerity not a number, n_lost zero, t zero.
///
/// Directions: x along the flow, y up, z across. Looking downstream with y up, +z is to the right
/// (x cross y = z), so the left horn is the one at z < Cz.
///
/// Regions are those of HeightMap. Lengths come from the edges of grains (centre +- d/2), not from
/// the edges of bins, so their error is the ambiguity of the outline, below one bin:
///   C        centroid of the solid volume of the region, sum of pi d^3 / 6
///   W        between the outermost edges in z
///   L        between the outermost edges in x inside the strip |z - Cz| < half width, going from
///            the crest up and down the stream until a column of bins is empty; the downstream end
///            is the lee foot, so that sand between the horns does not count
///   H        the highest value of the 3 x 3 median of h: within the slope times one bin of the
///            true crest, and blind to grains that fly
///   crest_x  mean x of the bins in the strip within max(0.05 h, d/2) of its highest median,
///            weighted by their height in that band, so that a moving crest moves smoothly
///   flux     streamwise volume flux of grains per width, sum of V_p u_x over the region's
///            footprint, which is the area of its bins
///   horns    from the lee foot on the centreline to the most downstream edge on either side of
///            the strip; zero for a heap
///   horns 2d the same of the grains of bins whose 3 x 3 median of h is at least two mean
///   diameters,
///            from their lee foot: single grains that trail from the horns do not count
/// When the strip is empty (no sand on the centreline) L is the whole extent in x, the horns zero.
/// Coordinates are in [0, length) along periodic directions; extents never exceed the period.
Dunes find_dunes(GrainCloud grains, const DuneDomain& domain, const DuneCriteria& criteria = {});

}  // namespace barchan
