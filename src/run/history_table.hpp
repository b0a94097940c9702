// Table history.csv: the state of a run over time.
#pragma once

#include <array>

#include "src/results/csv_table.hpp"

namespace barchan {

/// Line of history.csv. A new column is a member here and a line in kHistoryColumns; docs/files.md
/// has the meanings (a test compares).
struct HistoryRecord {
  double t = 0;  // [s]
  std::int64_t step = 0;
  double u_star = 0;                                          // from the wall shear [m/s]
  double bulk_velocity = 0;                                   // [m/s]
  double pressure_gradient = 0;                               // driving pressure gradient [Pa/m]
  double fluid_kinetic_energy = 0, grain_kinetic_energy = 0;  // [J]
  double cfl = 0;
  double continuity_residual = 0;  // largest of the interval [1/s]
  double pressure_iterations = 0;  // mean of the interval
  std::int64_t n_grains = 0, n_contacts = 0;
  double max_overlap = 0;             // over the mean diameter of the pair
  double grain_flux = 0;              // solid volume per width and time along x [m^2/s]
  double stress_on_grains = 0;        // stress of the flow along x, mean of the interval [Pa]
  std::int64_t n_fed = 0;             // grains that have come in
  double grain_step_over_stable = 0;  // grain step over the longest for which contacts are stable
  double bulk_velocity_z = 0, wanted_velocity_x = 0, wanted_velocity_z = 0;  // [m/s]
  double pressure_gradient_z = 0;                                            // [Pa/m]
  double grain_flux_z = 0, stress_on_grains_z = 0;                           // [m^2/s], [Pa]
};

inline constexpr std::array kHistoryColumns = [] {
  using H = HistoryRecord;
  return std::to_array<Column<H>>({
      {"t", "s", &H::t, "time", 10},
      {"step", "-", &H::step, "fluid step"},
      {"u_star", "m/s", &H::u_star,
       "friction velocity, sqrt(nu abs(mean dU/dy)) over the no-slip walls"},
      {"bulk_velocity", "m/s", &H::bulk_velocity,
       "mean velocity of the water, sum(alpha_f u V)/sum(alpha_f V)"},
      {"pressure_gradient", "Pa/m", &H::pressure_gradient,
       "driving gradient rho_f f of the last step"},
      {"fluid_kinetic_energy", "J", &H::fluid_kinetic_energy,
       "kinetic energy of the water, sum(rho_f alpha_f u^2 V)/2"},
      {"grain_kinetic_energy", "J", &H::grain_kinetic_energy,
       "kinetic energy of all grains, with spin"},
      {"cfl", "-", &H::cfl, "largest CFL number of the interval, dt (u/dx + v/dy + w/dz)", 6},
      {"continuity_residual", "1/s", &H::continuity_residual,
       "largest continuity residual of the interval, abs(div(alpha_f u) + d(alpha_f)/dt)", 6},
      {"pressure_iterations", "-", &H::pressure_iterations,
       "iterations of the pressure in a step, mean of the interval", 4},
      {"n_grains", "-", &H::n_grains, "grains inside"},
      {"n_contacts", "-", &H::n_contacts, "grain-grain pairs that touch"},
      {"max_overlap", "-", &H::max_overlap, "largest overlap of a pair over the sum of its radii",
       6},
      {"grain_flux", "m2/s", &H::grain_flux,
       "volume flux of all grains, sum(V_p u_x) over the floor's area"},
      {"stress_on_grains", "Pa", &H::stress_on_grains,
       "force of the flow along x on all grains over the floor's area; mean of the interval"},
      {"grain_step_over_stable", "-", &H::grain_step_over_stable,
       "grain step over the longest [stable one](choosing.md#grain-step)", 4},
      {"bulk_velocity_z", "m/s", &H::bulk_velocity_z,
       "as `bulk_velocity`, along z; 0 if never driven along z"},
      {"wanted_velocity_x", "m/s", &H::wanted_velocity_x,
       "required bulk velocity along x in the last step"},
      {"wanted_velocity_z", "m/s", &H::wanted_velocity_z, "required bulk velocity along z"},
      {"pressure_gradient_z", "Pa/m", &H::pressure_gradient_z, "driving gradient along z"},
      {"grain_flux_z", "m2/s", &H::grain_flux_z,
       "as `grain_flux`, along z; 0 if never driven along z"},
      {"stress_on_grains_z", "Pa", &H::stress_on_grains_z, "as `stress_on_grains`, along z"},
      {"n_fed", "-", &H::n_fed, "grains fed so far"},
  });
}();
inline constexpr CsvTable<HistoryRecord> kHistoryTable{"history.csv", kHistoryColumns};

}  // namespace barchan
