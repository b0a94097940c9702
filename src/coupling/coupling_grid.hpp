// The flow's grid as grains meet it: what gather and deposit share.
#pragma once

#include "kernels/coupling/flow_at_grains.hpp"
#include "src/coupling/deposit_stencil.hpp"
#include "src/fluid/boundary.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/fluid/poisson_fft.hpp"

namespace barchan {

/// A vector in the centres of cells.
struct CellVector {
  Field x, y, z;
  // NOLINTNEXTLINE(google-explicit-constructor): as its components convert
  operator CellVectorRef() const { return {x, y, z}; }
};

/// Nothing of it changes over a run.
struct CouplingGrid {
  CouplingGrid(const Config& config, const FluidSolver& solver, const Grid& of_flow, Real r_max);

  /// The implicit step of diffusion over the smoothing length.
  void smooth(Field& f) const { smoother.solve(f, f); }
  void fill_ghosts(FaceVector& f) const;  // constant beyond walls
  void fill_ghosts(CellVector& f) const;
  /// The first and the last face across which the smoothing does not go, in this rank's pencil.
  WallFaces wall_faces_x() const;
  WallFaces wall_faces_z() const;

  Grid grid;
  Boundary boundary;
  PeriodicBox box;  // of the grains
  DepositStencil stencil;
  bool by_row;   // the exchange of momentum
  bool crowded;  // by row, and twice as many grains may belong to a momentum cell as lie there
  Real smoothing_length;  // [m]; 0: none
  EvenExtension walls;    // of the grains, where the smoothing ends
  PoissonFft smoother;
};

}  // namespace barchan
