// Table bodies.csv: forces of fluid and grains on each body.
#pragma once

#include <array>
#include <cstdint>

#include "src/bodies/body_load.hpp"
#include "src/results/csv_table.hpp"

namespace barchan {

/// Mean load on one body over an interval.
struct BodyRecord {
  double t = 0;                                     // [s]
  std::int64_t body = 0;                            // number in the order of the case
  double force_x = 0, force_y = 0, force_z = 0;     // force of the fluid [N]
  double torque_x = 0, torque_y = 0, torque_z = 0;  // [N m]
  double grain_force_x = 0, grain_force_y = 0, grain_force_z = 0;
  double grain_torque_x = 0, grain_torque_y = 0, grain_torque_z = 0;
  std::int64_t n_contacts = 0;  // contacts with grains now
};

inline constexpr std::array kBodyColumns = [] {
  using B = BodyRecord;
  return std::to_array<Column<B>>({
      {"t", "s", &B::t, "end of the interval", 10},
      {"body", "-", &B::body, "number of the body in the case, from 0"},
      {"force_x", "N", &B::force_x, "force of the water along x"},
      {"force_y", "N", &B::force_y, "force of the water upwards"},
      {"force_z", "N", &B::force_z, "force of the water along z"},
      {"torque_x", "N m", &B::torque_x, "torque of the water about x"},
      {"torque_y", "N m", &B::torque_y, "torque of the water about y"},
      {"torque_z", "N m", &B::torque_z, "torque of the water about z"},
      {"grain_force_x", "N", &B::grain_force_x, "force of the grains along x"},
      {"grain_force_y", "N", &B::grain_force_y, "force of the grains upwards"},
      {"grain_force_z", "N", &B::grain_force_z, "force of the grains along z"},
      {"grain_torque_x", "N m", &B::grain_torque_x, "torque of the grains about x"},
      {"grain_torque_y", "N m", &B::grain_torque_y, "torque of the grains about y"},
      {"grain_torque_z", "N m", &B::grain_torque_z, "torque of the grains about z"},
      {"n_contacts", "-", &B::n_contacts, "grains that touch the body at `t`"},
  });
}();
inline constexpr CsvTable<BodyRecord> kBodyTable{"bodies.csv", kBodyColumns};

/// A line of the table.
BodyRecord body_record(double t, int body, const BodyLoad& water, const BodyLoad& grains,
                       std::int64_t n_contacts);

}  // namespace barchan
