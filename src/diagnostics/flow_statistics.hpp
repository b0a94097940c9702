// Turbulence statistics over planes of constant height and time (statistics.csv).
#pragma once

#include <vector>

#include "kernels/diagnostics/flow_statistics.hpp"
#include "src/config/config.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/io/checkpoint.hpp"

namespace barchan {

/// One line of statistics.csv, at the centre of a row of cells; what lives on y-faces is the mean
/// of the row's two. Stresses are kinematic [m^2/s^2]; a prime is the deviation from the plane's
/// mean over all samples.
struct StatisticsRow {
  double y = 0, u = 0;                         // [m], [m/s]
  double uu = 0, vv = 0, ww = 0, uv = 0;       // resolved <u'u'>, <v'v'>, <w'w'>, <u'v'>
  double viscous = 0, subgrid = 0, total = 0;  // nu dU/dy, subgrid, both less <u'v'>
  double p = 0, nu_t = 0;                      // [Pa], [m^2/s]
};

struct FlowStatisticsTable {
  double u_star = 0;  // of the mean shear at the floor [m/s]
  std::vector<StatisticsRow> rows;
};

class FlowStatistics {
 public:
  /// Ghosts of the flow must be valid when it is sampled.
  FlowStatistics(const FluidConfig& config, const Grid& grid);

  void sample(const FluidState& fluid);
  FlowStatisticsTable table() const;
  /// Writes statistics.csv, whole or not at all. Nothing without samples.
  void write(const std::filesystem::path& file) const;

  void save(CheckpointWriter& file) const;
  /// A restart of a run that had no statistics starts them anew.
  void load(const CheckpointReader& file);

 private:
  Grid grid_;
  double viscosity_;
  Kokkos::View<PlaneSums*> sample_;                   // of this rank
  Kokkos::View<PlaneSums*, Kokkos::HostSpace> sums_;  // of all ranks and samples
  std::int64_t n_samples_ = 0;
};

}  // namespace barchan
