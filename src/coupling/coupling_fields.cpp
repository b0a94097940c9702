#include "src/coupling/coupling_fields.hpp"

#include "src/parallel/poison.hpp"

namespace barchan {

CouplingFields::CouplingFields(const FluidSolver& solver, const CouplingGrid& at,
                               bool has_interlayer_drag)
    : of_grains(at.grid),
      of_fraction(at.grid),
      smoothed(at.grid),
      of_flow(at.grid),
      deposited(at.grid),
      of_impulse(at.grid),
      on_faces{make_faces("exchange impulse", at.grid)} {
  on_faces.regions = &of_flow;
  of_grains.set({}), of_fraction.set({});  // none yet
  const Workspace& idle = solver.workspace();
  pressure_on_faces = stress_on_faces = idle.flux;
  smoothed_pressure = idle.flux.x;
  convective = idle.u_star;
  const auto& [a, b, c] = idle.cells;
  pressure_in_cells = velocity_in_cells = impulse_in_cells = {a, b, c};
  stress_in_cells = {on_faces.impulse.x, on_faces.impulse.y, on_faces.impulse.z};

  if (at.smoothing_length > 0) {
    alpha_raw = Field("coupling: raw fraction", at.grid);
  }
  if (!has_interlayer_drag) return;
  on_faces.alpha_raw = alpha_raw;
  on_faces.interlayer_drag_x = Field("coupling: interlayer drag, x", at.grid);
  on_faces.interlayer_drag_z = Field("coupling: interlayer drag, z", at.grid);
  solid_x = on_faces.interlayer_drag_x, solid_z = on_faces.interlayer_drag_z;
}

void CouplingFields::lend_to_gather() const {
  poison(pressure_on_faces);
  poison(convective);
  poison(pressure_in_cells.x, pressure_in_cells.y, pressure_in_cells.z);
  poison(on_faces.impulse);
  poison(on_faces.interlayer_drag_x, on_faces.interlayer_drag_z, alpha_raw);
}

void CouplingFields::lend_to_deposit() const {
  poison(impulse_in_cells.x, impulse_in_cells.y, impulse_in_cells.z);
  poison(on_faces.impulse);
  poison(on_faces.interlayer_drag_x, on_faces.interlayer_drag_z);
}

void CouplingFields::give_back() const {
  poison_finite(impulse_in_cells.x, impulse_in_cells.y, impulse_in_cells.z);
}

}  // namespace barchan
