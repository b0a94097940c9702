// Relaxation of the columns that grains obstruct, around a direct solve for clear fluid.
#pragma once

#include "kernels/fluid/column_relaxation.hpp"
#include "src/fluid/poisson_fft.hpp"
#include "src/parallel/halo.hpp"
#include "src/parallel/region.hpp"

namespace barchan {

/// Preconditioner where grains hinder the flow: the constant-coefficient solve misses the few cells
/// where c is far below one. Symmetric multiplicative combination: relax the columns with grains
/// (block SOR over columns, by colours), solve globally for what is left, relax again in
/// the reverse order. Symmetric and positive definite in the volume-weighted inner product. It
/// keeps nothing from step to step, so a restarted run repeats the same bits.
class LocalCorrection {
 public:
  LocalCorrection(const Grid& grid, const Halo& halo);

  /// Cells around obstructed faces, with c < 1, that sweeps and the residual after them reach.
  static constexpr int kReach = 5;

  /// Finds the columns of the mobility c within `near`, outside which c is one; to be called when c
  /// changed. `workspace`: a field whose values nobody needs while sweeps go on.
  void update(const FaceVector& c, const Region& near, const Field& workspace);
  void set_workspace(const Field& workspace) { workspace_ = workspace; }

  /// Sweeps over these columns that bring A z closer to r; z has ghosts. Backward they are the
  /// adjoint of forward.
  void relax(const Field& r, Field& z, bool forward);
  /// z = M^-1 r; r changes and is as before on return. One more field holds a copy meanwhile.
  void apply(const PoissonFft& poisson, Field& r, Field& z, Field& copy_of_r);

 private:
  template <class Functor>
  void each_column(const char* label, const Functor& functor) const;

  Grid grid_;
  Halo halo_;
  FaceVector c_;
  const Region* near_ = nullptr;
  CellRange bounds_;  // of `near`
  Grid flat_;         // one row of cells
  Halo flat_halo_;
  Field mask_, mask_1_, mask_2_;  // ColumnHeights: obstructed; one layer more; two
  Field pivot_, workspace_;
  Field local_;  // zero between two calls of apply()
};

}  // namespace barchan
