// Files of a case: its keys.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kernels/bodies/shape.hpp"

namespace barchan {

/// [[output.probe]]: a point, or points at equal distances on a line, at which the flow is written.
struct ProbeConfig {
  std::string name;  // in tables and pictures, required
  std::optional<std::array<double, 3>> at = {}, from = {}, to = {};  // or a line's ends [m]
  int points = 0;                                                    // of a line, with its ends
  double interval = 0.01;                                            // [s]
  bool operator==(const ProbeConfig&) const = default;
};

/// [[output.slice]]: the layer of cells at a place, with all fields of the flow.
struct SliceConfig {
  std::string name;  // of its file, required
  Axis normal = Axis::y;
  double at = 0;          // place along the normal [m], required
  double interval = 0.1;  // [s]
  bool operator==(const SliceConfig&) const = default;
};

/// [output], intervals in simulated seconds; 0 turns a file off.
struct OutputConfig {
  double history_interval = 0.01;
  double dune_interval = 0.05;
  double grains_interval = 0.1;
  double fields_interval = 0.5;
  double tracks_interval = 0;  // ids and positions alone, in tracks.h5
  bool grain_forces = false;   // each force separately in grains.h5
  std::vector<ProbeConfig> probes = {};
  std::vector<SliceConfig> slices = {};
  bool operator==(const OutputConfig&) const = default;
};

/// [statistics]: averages over time; those over planes always. Off without the section.
struct StatisticsConfig {
  double start = 0;           // [s], required
  double interval = 0.01;     // between samples [s]
  bool fields = false;        // means and second moments of the flow in every cell
  bool grain_forces = false;  // resultant force on the grains in polar bins around the main dune
  bool bed_load = false;      // profiles of the grains, and surface, stress and load of the bed
  bool operator==(const StatisticsConfig&) const = default;
};

}  // namespace barchan
