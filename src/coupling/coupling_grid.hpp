// Grid of the flow as grains meet it, shared by gather and deposit.
#pragma once

#include "kernels/coupling/flow_at_grains.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/coupling/smoother.hpp"
#include "src/fluid/boundary.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// Vector in the centres of cells.
struct CellVector {
  Field x, y, z;
  // NOLINTNEXTLINE(google-explicit-constructor): as its components convert
  operator CellVectorRef() const { return {x, y, z}; }
};

/// Grid of the exchange. Nothing of it changes over a run.
struct CouplingGrid {
  CouplingGrid(const CoupledCase& config, const FluidSolver& solver, const Grid& of_flow,
               Real r_max, PointModel points);

  /// Clears `marks`, and marks the columns of cells that these grains give to, and read from.
  void mark_columns_of(const GrainState& grains) const;
  /// Columns of the grains, from the fetched marks. All ranks call it together.
  ColumnMap columns_of_grains() const;
  /// Fills the ghosts beside a region; beyond walls the values are constant.
  void fill_ghosts(FaceVector& f, const Region& region) const;
  void fill_ghosts(CellVector& f, const Region& region) const;
  /// Divides f by the share that the smoothing keeps in the fluid, if bodies take any.
  void renormalise(Field& f, const Region& region) const;
  /// First and last face across which the smoothing does not go, in this rank's pencil.
  WallFaces wall_faces_x() const;
  WallFaces wall_faces_z() const;

  Grid grid;
  Boundary boundary;
  PeriodicBox box;  // periods of the grains
  DepositStencil stencil;
  Real smoothing_length;  // [m]; 0: no smoothing
  Real reach_of_grain;    // radius of the largest [m]
  EvenExtension walls;    // walls of the grains, where the smoothing ends
  Smoother smoother;
  const BodiesInFlow* bodies;  // nullptr without bodies
  int pressure_reach;          // cells around obstructed faces that the pressure solver needs
  Field smoothing_weight;      // share of a smoothed field that bodies leave; empty: all
  enum Mark : int { kOfGrains, kOfFraction, kMarks };  // alpha_f is less than one
  ColumnMarks marks;
};

}  // namespace barchan
