// Table dune.csv: the dunes of a run over time.
#pragma once

#include <array>

#include "src/diagnostics/dune_shape.hpp"
#include "src/results/csv_table.hpp"

namespace barchan {

inline constexpr std::array kDuneColumns = [] {
  using D = DuneRecord;
  return std::to_array<Column<D>>({
      {"t", "s", &D::t, "time", 10},
      {"dune", "-", &D::dune, "label of the dune; 0: the largest at the first time"},
      {"n_grains", "-", &D::n_grains, "grains of the dune"},
      {"W", "m", &D::w, "width"},
      {"L", "m", &D::l, "length along the centreline"},
      {"H", "m", &D::h, "height"},
      {"Cx", "m", &D::cx, "x of the centroid"},
      {"Cy", "m", &D::cy, "height of the centroid"},
      {"Cz", "m", &D::cz, "z of the centroid"},
      {"horn_left", "m", &D::horn_left, "length of the horn at z < Cz"},
      {"horn_right", "m", &D::horn_right, "length of the horn at z > Cz"},
      {"crest_x", "m", &D::crest_x, "crest on the centreline"},
      {"volume", "m3", &D::volume, "solid volume, sum of pi d^3/6"},
      {"celerity", "m/s", &D::celerity,
       "celerity, slope of Cx over the last second; `nan` at a dune's first time"},
      {"n_lost", "-", &D::n_lost, "grains that have left the domain so far"},
      {"flux", "m2/s", &D::flux,
       "volume flux of its grains, sum(V_p u_x) over the area of its bins"},
      {"horn_left_2d", "m", &D::horn_left_2d, "as `horn_left`, of sand two grains high or more"},
      {"horn_right_2d", "m", &D::horn_right_2d, "as `horn_right`, of sand two grains high or more"},
  });
}();
inline constexpr CsvTable<DuneRecord> kDuneTable{"dune.csv", kDuneColumns};

}  // namespace barchan
