// Mean resultant force on the grains in polar bins about the main dune (force_map.csv).
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "kernels/math/vec3.hpp"
#include "src/diagnostics/dune_shape.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

/// Ensemble averages as in Fig. 13 of Lima et al. (2022): over all grains that are in a bin at the
/// times of the samples, buried ones included. Bins are polar about the centroid of the largest
/// dune at that time: radius in steps of 2.5 mean diameters up to 100, angle in steps of 10
/// degrees, 0 downstream, 90 left (z < C_z), 270 right.
class ForceMap {
 public:
  static constexpr int n_radii = 40, n_angles = 36;
  static constexpr double bin_diameters = 2.5;

  explicit ForceMap(const DuneDomain& domain)
      : domain_(domain), bins_(std::size_t{n_radii} * n_angles) {}

  /// force: resultant on each grain [N], rows as in the cloud. Nothing while there is no dune.
  void sample(double t, GrainCloud grains, std::span<const Vec3> force);

  struct Bin {
    double n = 0;  // grain samples
    Vec3 force;    // their sum [N]
  };
  /// By angle first, then by radius.
  const std::vector<Bin>& bins() const { return bins_; }
  double radius_step() const { return step_; }  // [m]

  /// Writes force_map.csv, whole or not at all. Nothing without samples.
  void write(const std::filesystem::path& file) const;
  void save(CheckpointWriter& file) const;
  /// A restart of a run that had no map starts it anew.
  void load(const CheckpointReader& file);

 private:
  DuneDomain domain_;
  std::vector<Bin> bins_;
  double step_ = 0;             // width of a bin along the radius [m]; 0: no sample yet
  double start_ = 0, end_ = 0;  // first and last sample [s]
};

}  // namespace barchan
