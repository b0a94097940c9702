// Outputs of each grain in grains.h5 and tracks.h5.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/coupling/grain_forces.hpp"
#include "src/results/outputs.hpp"

namespace barchan {

/// Label of the dune that each grain of this rank belongs to, -1: none; empty: not known.
using DuneLabels = std::optional<std::vector<int>>;

/// Data that the arrays of a frame are computed from.
struct GrainFrame {
  const GrainState& grains;
  PeriodicBox box = {};     // positions are written as the images within
  ForceArrays forces = {};  // empty: not asked for
  DuneLabels dunes = {};
};

/// Writes all arrays of grains [0, n) that the run has: grains.h5. Collective over the ranks of the
/// grains.
void write_grain_outputs(Hdf5File& file, const std::string& group, const GrainFrame& frame);
/// Writes the arrays of tracks.h5 alone.
void write_track_outputs(Hdf5File& file, const std::string& group, const GrainFrame& frame);

/// Writes the spheres of the clumps of each kind, once a file: none in runs without clumps.
void write_clump_shapes(Hdf5File& file, const GrainState& grains);

/// All arrays of grains.h5, for the page; the second function, those of write_clump_shapes().
std::vector<Output> grain_outputs();
std::vector<Output> clump_shape_outputs();

}  // namespace barchan
