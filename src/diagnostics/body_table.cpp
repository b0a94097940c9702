#include "src/diagnostics/body_table.hpp"

namespace barchan {

BodyRecord body_record(double t, int body, const BodyLoad& water, const BodyLoad& grains,
                       std::int64_t n_contacts) {
  return {.t = t,
          .body = body,
          .force_x = water.force.x,
          .force_y = water.force.y,
          .force_z = water.force.z,
          .torque_x = water.torque.x,
          .torque_y = water.torque.y,
          .torque_z = water.torque.z,
          .grain_force_x = grains.force.x,
          .grain_force_y = grains.force.y,
          .grain_force_z = grains.force.z,
          .grain_torque_x = grains.torque.x,
          .grain_torque_y = grains.torque.y,
          .grain_torque_z = grains.torque.z,
          .n_contacts = n_contacts};
}

}  // namespace barchan
