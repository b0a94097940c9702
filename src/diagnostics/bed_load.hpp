// Profiles of grains in transport over horizontal layers and time, the surface of the bed, and the
// stress and the load there (bedload.csv).
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "src/fluid/fluid_state.hpp"
#include "src/grains/grain_state.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/results/csv_table.hpp"

namespace barchan {

/// Line of bedload.csv: a layer. Numbers of the bed are equal in all lines.
struct BedLoadRecord {
  double y = 0, solid_fraction = 0, grain_velocity = 0;            // [m], [-], [m/s]
  double flux_density = 0, particle_pressure = 0, shear_rate = 0;  // [m/s], [Pa], [1/s]
  double production = 0, total_stress = 0;                         // [W/m^3], [Pa]
  double bed_surface = 0, bed_stress = 0, shields = 0;             // [m], [Pa], [-]
  double load = 0, load_velocity = 0, q = 0, q_star = 0;           // [kg/m^2], [m/s], [m^2/s], [-]
  double d = 0, t_start = 0, t_end = 0;                            // [m], [s], [s]
  std::int64_t n_samples = 0;
};
inline constexpr std::array kBedLoadColumns = [] {
  using B = BedLoadRecord;
  return std::to_array<Column<B>>({
      {"y", "m", &B::y, "height of the middle of the layer"},
      {"solid_fraction", "-", &B::solid_fraction, "share of the layer that grains fill"},
      {"grain_velocity", "m/s", &B::grain_velocity,
       "mean velocity of the grains along x, by volume; 0 where there are none"},
      {"flux_density", "m/s", &B::flux_density, "volume flux of grains, the product of both"},
      {"particle_pressure", "Pa", &B::particle_pressure, "submerged weight of the grains above"},
      {"shear_rate", "1/s", &B::shear_rate, "d(`grain_velocity`)/dy"},
      {"production", "W/m3", &B::production,
       "production of fluctuation energy, `particle_pressure` times `shear_rate`"},
      {"total_stress", "Pa", &B::total_stress, "shear stress of water and grains along x"},
      {"bed_surface", "m", &B::bed_surface,
       "height of the largest production, by a parabola; `nan` with what follows from it at rest"},
      {"bed_stress", "Pa", &B::bed_stress, "total stress there"},
      {"shields", "-", &B::shields, "`bed_stress` over (rho_p - rho_f) g d"},
      {"load", "kg/m2", &B::load, "mass of the grains above the bed surface"},
      {"load_velocity", "m/s", &B::load_velocity, "mass flux of all grains over `load`"},
      {"q", "m2/s", &B::q, "volume flux of all grains, the sum of `flux_density` over height"},
      {"q_star", "-", &B::q_star, "q over sqrt((rho_p/rho_f - 1) g d^3)"},
      {"d", "m", &B::d, "mean diameter of the grains at the first sample"},
      {"t_start", "s", &B::t_start, "time of the first sample"},
      {"t_end", "s", &B::t_end, "time of the last sample"},
      {"n_samples", "-", &B::n_samples, "instants averaged"},
  });
}();
inline constexpr CsvTable<BedLoadRecord> kBedLoadTable{"bedload.csv", kBedLoadColumns};

/// Means over layers of equal height, a quarter of the mean diameter, over the whole plane of the
/// box and over time. A clump counts as the sphere of its volume around its centre. Where the bed
/// lies in a part of the box, they are means with what is beside it.
class BedLoad {
 public:
  static constexpr int layers_per_diameter = 4;

  struct Surroundings {
    double fluid_density = 0;      // [kg/m^3]
    double viscosity = 0;          // [m^2/s]
    Vec3 gravity;                  // [m/s^2], towards the floor
    bool fluid_in_grains = false;  // resolved: the flow fills the grains as well
  };
  BedLoad(const Surroundings& around, const Grid& grid) : around_(around), grid_(grid) {}

  /// Adds one time. Does nothing while there are no grains. All ranks call it together.
  void sample(const FluidState& fluid, const GrainState& entries, double t);
  /// Lines from the floor up; none without samples.
  std::vector<BedLoadRecord> table() const;
  /// Writes bedload.csv, whole or not at all; does nothing without samples.
  void write(const std::filesystem::path& file) const;

  void save(CheckpointWriter& file) const;
  /// Reads the sums of a restart file. If it has none, the means start anew.
  void load(const CheckpointReader& file);

  /// Grains of a layer, over its volume; sums over samples.
  struct Layer {
    double volume = 0, flux = 0;    // [-], times the velocity [m/s]
    double mass = 0, momentum = 0;  // [kg/m^3], [kg/(m^2 s)]
  };

 private:
  /// Numbers of all samples, as a restart file has them.
  struct Sums {
    double d = 0;                              // mean diameter [m]; 0: no sample yet
    double n_samples = 0, start = 0, end = 0;  // [-], [s], [s]
    double gradient = 0, top_stress = 0;       // sums over samples [Pa/m], [Pa]
  };

  double layer_height() const { return grid_.ly / static_cast<double>(layers_.size()); }
  void make_layers(const GrainState& grains);
  std::vector<Layer> layers_now(const GrainState& grains) const;
  std::vector<double> row_sums(const FluidState& fluid) const;
  std::vector<double> momentum_now(const std::vector<Layer>& grains,
                                   const std::vector<double>& rows) const;

  Surroundings around_;
  Grid grid_;
  Sums sums_;
  std::vector<Layer> layers_;
  std::vector<double> first_momentum_, last_momentum_;  // of fluid and grains [kg/(m^2 s)]
};

}  // namespace barchan
