// Everything the fluid remembers from one step to the next.
#pragma once

#include <string>
#include <type_traits>

#include "src/fluid/fluid_fields.hpp"

namespace barchan {

/// Volume-averaged flow on the staggered grid; its fields are listed in fluid_fields.hpp. Ghosts of
/// u, p, alpha_f and nu_t are valid between steps.
struct FluidState {
  Grid grid;
  FaceVector u;              // interstitial fluid velocity [m/s]
  Field p, p_previous;       // pressure without the hydrostatic and driving parts [Pa], n and n-1
  Field alpha_f;             // fluid volume fraction [-]
  Field alpha_f_previous;    // the same before the last deposit
  Field nu_t;                // eddy viscosity [m^2/s]
  FaceVector rate_previous;  // -div(alpha u u) + alpha div(tau)/rho at n-1 [m/s^2]
  FaceVector du_dt;          // change of u over the last step divided by it [m/s^2]
  Vec2 drive;                // driving body force per unit mass [m/s^2]
  bool has_history = false;  // rate_previous and p_previous hold a step for Adams-Bashforth
  Real dt_previous = 0;      // length of that step [s]
  Real time = 0;             // since the start [s]
  Vec2 bulk_at_start;        // bulk velocity a ramp of the drive starts from [m/s]
  Vec2 flow_rate_defect;  // flow rate by which the last projection missed that of the drive [m^2/s]
};

/// Zero everywhere.
inline FaceVector make_faces(const char* label, const Grid& grid) {
  return {Field(label, grid), Field(label, grid), Field(label, grid)};
}

/// Calls action(field, suffix of its name) for a field, or for each component of a face vector.
template <class Action>
void for_each_component(const Field& f, const Action& action) {
  action(f, "");
}
template <class Action>
void for_each_component(const FaceVector& f, const Action& action) {
  action(f.x, "_x");
  action(f.y, "_y");
  action(f.z, "_z");
}

/// Every field as it is at rest.
inline FluidState make_fluid_state(const Grid& grid) {
  FluidState s;
  s.grid = grid;
  for_each_fluid_field(s, [&](auto& member, const FluidField& field) {
    const std::string label = std::string("fluid: ") + field.name;
    if constexpr (std::is_same_v<decltype(member), FaceVector&>) {
      member = make_faces(label.c_str(), grid);
    } else {
      member = Field(label.c_str(), grid);
    }
    for_each_component(member, [&](const Field& f, const char*) {
      if (field.at_rest != 0) Kokkos::deep_copy(f.storage, field.at_rest);
    });
  });
  return s;
}

}  // namespace barchan
