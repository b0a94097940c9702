#pragma once

#include <cstdint>
#include <vector>

#include "src/dune_map.hpp"

namespace barchan {

/// One line of dune.csv: the shape of one dune at one time.
///
/// Directions: x along the flow, y up, z across. Looking downstream with y up, +z is to the right
/// (x cross y = z), so the left horn is the one at z < Cz.
struct DuneRow {
  double t = 0.0;             ///< [s]
  int dune = 0;               ///< label; stays with a dune, 0 is the largest of the first time
  std::int64_t n_grains = 0;  ///< grains in the dune
  double W = 0.0;             ///< width: extent across the flow [m]
  double L = 0.0;             ///< length: from toe to lee foot along the centreline z = Cz [m]
  double H = 0.0;             ///< height of the crest above the wall [m]
  double Cx = 0.0;            ///< centroid of the solid volume [m]
  double Cy = 0.0;            ///< [m]
  double Cz = 0.0;            ///< [m]
  double horn_left = 0.0;     ///< most downstream edge at z < Cz, from the lee foot; 0: heap [m]
  double horn_right = 0.0;    ///< the same at z > Cz [m]
  double crest_x = 0.0;       ///< of the crest on the centreline [m]
  double volume = 0.0;        ///< of solid, sum of pi d^3 / 6 [m^3]
  double celerity = 0.0;      ///< dCx/dt [m/s]; not a number until two times are known
  std::int64_t n_lost = 0;    ///< grains that have left the domain since the first time
};

/// Finds the dunes in the grains and measures each; rows in descending order of volume, labelled
/// 0, 1, ... in that order; celerity not a number, n_lost zero, t zero.
///
/// Regions are those of HeightMap. Lengths come from the edges of grains (centre +- d/2), not from
/// the edges of bins, so their error is the ambiguity of the outline, below one bin:
///   W        between the outermost edges in z
///   L        between the outermost edges in x inside the strip |z - Cz| < half width, going from
///            the crest up and down the stream until a column of bins is empty; the downstream end
///            is the lee foot, so that sand between the horns does not count
///   H        the highest value of the 3 x 3 median of h: within the slope times one bin of the
///            true crest, and blind to grains that fly
///   crest_x  mean x of the bins in the strip within max(0.05 h, d/2) of its highest median,
///            weighted by their height in that band, so that a moving crest moves smoothly
///   horns    as in DuneRow; when the strip is empty (no sand on the centreline) L is the whole
///            extent in x and the horns are zero
/// Coordinates are in [0, length) along periodic directions; extents never exceed the period.
std::vector<DuneRow> measure_dunes(const GrainCloud& grains, const DuneDomain& domain,
                                   const DuneCriteria& criteria = {});

}  // namespace barchan
