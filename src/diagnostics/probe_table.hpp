// Table probes.csv: the flow at the points of each probe.
#pragma once

#include <array>
#include <cstdint>

#include "src/results/csv_table.hpp"

namespace barchan {

/// Flow at one point of a probe at one time.
struct ProbeRecord {
  double t = 0;                               // [s]
  std::int64_t probe = 0, point = 0;          // number in the order of the case; along the line
  double x = 0, y = 0, z = 0;                 // [m]
  double u = 0, v = 0, w = 0;                 // [m/s]
  double p = 0;                               // [Pa]
  double wall_shear_x = 0, wall_shear_z = 0;  // [Pa]
};

inline constexpr std::array kProbeColumns = [] {
  using P = ProbeRecord;
  return std::to_array<Column<P>>({
      {"t", "s", &P::t, "time", 10},
      {"probe", "-", &P::probe, "number of the probe in the case, from 0"},
      {"point", "-", &P::point, "number of the point on its line, from 0"},
      {"x", "m", &P::x, "place of the point along the flow"},
      {"y", "m", &P::y, "height of the point"},
      {"z", "m", &P::z, "place of the point across the flow"},
      {"u", "m/s", &P::u, "velocity of the water along x"},
      {"v", "m/s", &P::v, "velocity of the water upwards"},
      {"w", "m/s", &P::w, "velocity of the water along z"},
      {"p", "Pa", &P::p, "pressure without its hydrostatic and driving parts"},
      {"wall_shear_x", "Pa", &P::wall_shear_x,
       "shear stress on the floor below the point, along x"},
      {"wall_shear_z", "Pa", &P::wall_shear_z,
       "shear stress on the floor below the point, along z"},
  });
}();
inline constexpr CsvTable<ProbeRecord> kProbeTable{"probes.csv", kProbeColumns};

}  // namespace barchan
