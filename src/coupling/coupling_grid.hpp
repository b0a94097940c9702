// The flow's grid as grains meet it: what gather and deposit share.
#pragma once

#include "kernels/coupling/flow_at_grains.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/coupling/smoother.hpp"
#include "src/fluid/boundary.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// A vector in the centres of cells.
struct CellVector {
  Field x, y, z;
  // NOLINTNEXTLINE(google-explicit-constructor): as its components convert
  operator CellVectorRef() const { return {x, y, z}; }
};

/// Nothing of it changes over a run.
struct CouplingGrid {
  CouplingGrid(const CoupledCase& config, const FluidSolver& solver, const Grid& of_flow,
               Real r_max, PointModel points);

  /// Clears `marks`, and marks the columns of cells that these grains give to, and read from.
  void mark_columns_of(const GrainState& grains) const;
  /// As they were fetched. All ranks together.
  ColumnMap columns_of_grains() const;
  /// Ghosts beside a region; constant beyond walls.
  void fill_ghosts(FaceVector& f, const Region& region) const;
  void fill_ghosts(CellVector& f, const Region& region) const;
  /// f over the share that the smoothing keeps in the water, if bodies take any.
  void raise_to_kept(Field& f, const Region& region) const;
  /// The first and the last face across which the smoothing does not go, in this rank's pencil.
  WallFaces wall_faces_x() const;
  WallFaces wall_faces_z() const;

  Grid grid;
  Boundary boundary;
  PeriodicBox box;  // of the grains
  DepositStencil stencil;
  Real smoothing_length;  // [m]; 0: none
  Real reach_of_grain;    // of its points from its centre [m]
  EvenExtension walls;    // of the grains, where the smoothing ends
  Smoother smoother;
  const BodiesInFlow* bodies;  // null without
  int pressure_reach;          // cells around obstructed faces that the pressure solver needs
  Field kept;                  // share of what is smoothed that bodies leave; empty: all
  enum Mark : int { kOfGrains, kOfFraction, kMarks };  // alpha_f is less than one
  ColumnMarks marks;
};

}  // namespace barchan
