// Mean resultant force on the grains in polar bins about the main dune (force_map.csv).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "kernels/math/vec3.hpp"
#include "src/diagnostics/dune_shape.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/results/csv_table.hpp"

namespace barchan {

/// One line of force_map.csv: a bin that has grains.
struct ForceMapRecord {
  double r_min = 0, r_max = 0, phi_min = 0, phi_max = 0;  // [m], [degree]
  std::int64_t n = 0;
  double x = 0, y = 0, z = 0;  // [N]
  double t_start = 0, t_end = 0;
};
inline constexpr std::array kForceMapColumns = [] {
  using F = ForceMapRecord;
  return std::to_array<Column<F>>({
      {"r_min", "m", &F::r_min, "inner distance of the bin from the centroid of the dune"},
      {"r_max", "m", &F::r_max, "outer distance of the bin"},
      {"phi_min", "degree", &F::phi_min, "smaller angle of the bin", 6},
      {"phi_max", "degree", &F::phi_max, "larger angle of the bin", 6},
      {"n", "-", &F::n, "samples of grains"},
      {"F_x", "N", &F::x, "mean force along x", 6},
      {"F_y", "N", &F::y, "mean force upwards", 6},
      {"F_z", "N", &F::z, "mean force along z", 6},
      {"t_start", "s", &F::t_start, "time of the first sample, equal in all lines"},
      {"t_end", "s", &F::t_end, "time of the last sample, equal in all lines"},
  });
}();
inline constexpr CsvTable<ForceMapRecord> kForceMapTable{"force_map.csv", kForceMapColumns};

/// Map of mean forces as in Fig. 13 of Lima et al. (2022): ensemble averages over all grains that
/// are in a bin at the times of the samples, buried ones included. Bins are polar about the
/// centroid of the largest dune at that time: radius in steps of 2.5 mean diameters up to 100,
/// angle in steps of 10 degrees, 0 downstream, 90 left (z < C_z), 270 right.
class ForceMap {
 public:
  static constexpr int n_radii = 40, n_angles = 36;
  static constexpr double bin_diameters = 2.5;

  explicit ForceMap(const DuneDomain& domain)
      : domain_(domain), bins_(std::size_t{n_radii} * n_angles) {}

  /// Adds one time. `force`: resultant on each grain [N], rows as in the cloud. Does nothing while
  /// there is no dune.
  void sample(double t, GrainCloud grains, std::span<const Vec3> force);

  struct Bin {
    double n = 0;  // grain samples
    Vec3 force;    // sum of the forces [N]
  };
  /// Bins, by angle first, then by radius.
  const std::vector<Bin>& bins() const { return bins_; }
  double radius_step() const { return step_; }  // [m]

  /// Writes force_map.csv, whole or not at all; does nothing without samples.
  void write(const std::filesystem::path& file) const;
  void save(CheckpointWriter& file) const;
  /// Reads the sums of a restart file. If it has none, the map starts anew.
  void load(const CheckpointReader& file);

 private:
  DuneDomain domain_;
  std::vector<Bin> bins_;
  double step_ = 0;             // width of a bin along the radius [m]; 0: no sample yet
  double start_ = 0, end_ = 0;  // first and last sample [s]
};

}  // namespace barchan
