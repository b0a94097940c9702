// Fields of the exchange between flow and grains.
#pragma once

#include "src/coupling/coupling_grid.hpp"
#include "src/fluid/exchange_on_faces.hpp"

namespace barchan {

/// A name for each meaning. Names of one declaration share memory: each is written after the one
/// before it was read for the last time. Most of this memory is the Workspace of the flow
/// solver, which needs it only within its steps. The constructor, and nothing else, says which
/// memory is whose.
struct CouplingFields {
  CouplingFields(const FluidSolver& solver, const CouplingGrid& at, bool has_interlayer_drag);
  CouplingFields(const CouplingFields&) = delete;

  /// Lends memory whose old values are not read any more; poison.hpp.
  void lend_to_gather() const;
  void lend_to_deposit() const;
  void give_back() const;

  // Gather, smoothed [Pa]; force per volume of grain on faces [N/m^3].
  Field smoothed_pressure;
  FaceVector pressure_on_faces, stress_on_faces;

  // Gather, u . grad u on faces [m/s^2].
  FaceVector convective;

  // Gather, force per volume in cells [N/m^3]; the velocity of CFDEM's cells [m/s]; deposit,
  // momentum given to the grains per volume [N s/m^3].
  CellVector pressure_in_cells, velocity_in_cells, impulse_in_cells;

  // Gather, force per volume in cells [N/m^3]. Shares memory with the impulse of `on_faces`, which
  // the last fluid step has read and the next deposit writes.
  CellVector stress_in_cells;

  // Layered gather, solid in the momentum cells around faces, per volume.
  // Shares memory with the coefficients of the interlayer drag of `on_faces`, likewise.
  Field solid_x, solid_z;

  // Cells of the grains, and cells where alpha_f is less than one: set before the gather.
  ActiveRegion of_grains, of_fraction;
  // Cells over which the deposit spreads the grains' volume.
  Region smoothed;
  // Cells that the flow has to know: all of these, and the last ones of alpha_f. Set by the
  // deposit.
  FlowRegions of_flow;
  // Cells that grains give to; those whose impulse goes to the faces of `of_flow.exchange`, without
  // layers.
  Region deposited, of_impulse;

  // Kept through the fluid step.
  Field alpha_raw;           // set by the gather, within of_flow; empty without smoothing
  ExchangeOnFaces on_faces;  // set by the deposit

  /// Fluid fraction before the smoothing, with ghosts; alpha_f itself where nothing is smoothed.
  const Field& raw_fraction(const FluidState& fluid) const {
    return alpha_raw.storage.size() > 0 ? alpha_raw : fluid.alpha_f;
  }
};

}  // namespace barchan
