// Turbulence statistics over planes of constant height and time (statistics.csv).
#pragma once

#include <array>
#include <vector>

#include "kernels/diagnostics/flow_statistics.hpp"
#include "src/case/config.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/results/csv_table.hpp"

namespace barchan {

/// Line of statistics.csv, at the centre of a row of cells; values on y-faces are means of the
/// row's two. Stresses are kinematic [m^2/s^2]; a prime is the deviation from the plane's mean over
/// all samples.
struct StatisticsRecord {
  double y = 0, y_plus = 0, u = 0, u_plus = 0;  // [m], y u_star/nu, [m/s], u/u_star
  double uu = 0, vv = 0, ww = 0, uv = 0;        // resolved <u'u'>, <v'v'>, <w'w'>, <u'v'>
  double viscous = 0, subgrid = 0, total = 0;   // nu dU/dy, subgrid stress, both less <u'v'>
  double k = 0;                                 // (uu + vv + ww)/2
  double p = 0, nu_t = 0;                       // [Pa], [m^2/s]
  std::int64_t n_samples = 0;
};
inline constexpr std::array kStatisticsColumns = [] {
  using S = StatisticsRecord;
  return std::to_array<Column<S>>({
      {"y", "m", &S::y, "height of the cell layer"},
      {"y_plus", "-", &S::y_plus,
       "height in wall units, y u_star/nu with u_star of the mean stress at the floor", 6},
      {"U", "m/s", &S::u, "mean velocity along x"},
      {"U_plus", "-", &S::u_plus, "U over u_star", 6},
      {"uu", "m2/s2", &S::uu, "resolved stress <u'u'>"},
      {"vv", "m2/s2", &S::vv, "resolved stress <v'v'>"},
      {"ww", "m2/s2", &S::ww, "resolved stress <w'w'>"},
      {"uv", "m2/s2", &S::uv, "resolved stress <u'v'>, as the scheme transports it"},
      {"k", "m2/s2", &S::k, "resolved kinetic energy, (uu + vv + ww)/2"},
      {"viscous_stress", "m2/s2", &S::viscous, "viscous stress, nu dU/dy"},
      {"subgrid_stress", "m2/s2", &S::subgrid, "stress of the subgrid model"},
      {"total_stress", "m2/s2", &S::total,
       "viscous and subgrid stress minus <u'v'>; linear in y in a steady flow"},
      {"p", "Pa", &S::p, "mean pressure without its driving part"},
      {"nu_t", "m2/s", &S::nu_t, "mean eddy viscosity"},
      {"n_samples", "-", &S::n_samples, "instants averaged"},
  });
}();
inline constexpr CsvTable<StatisticsRecord> kStatisticsTable{"statistics.csv", kStatisticsColumns};

struct FlowStatisticsTable {
  double u_star = 0;  // from the mean shear at the floor [m/s]
  std::vector<StatisticsRecord> lines;
};

class FlowStatistics {
 public:
  /// Makes empty sums. Ghosts of the flow must be valid when it is sampled.
  FlowStatistics(const FluidConfig& config, const Grid& grid);

  void sample(const FluidState& fluid);
  FlowStatisticsTable table() const;
  /// Writes statistics.csv, whole or not at all; does nothing without samples.
  void write(const std::filesystem::path& file) const;

  void save(CheckpointWriter& file) const;
  /// Reads the sums of a restart file. If it has none, the statistics start anew.
  void load(const CheckpointReader& file);

 private:
  Grid grid_;
  double viscosity_;
  Kokkos::View<PlaneSums*> sample_;                   // sums on this rank
  Kokkos::View<PlaneSums*, Kokkos::HostSpace> sums_;  // sums over all ranks and samples
  std::int64_t n_samples_ = 0;
};

}  // namespace barchan
