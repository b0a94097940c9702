// Preconditioner where grains hinder the flow: columns relaxed before and after the FFT solve.
#pragma once

#include "kernels/fluid/column_relaxation.hpp"
#include "src/fluid/poisson_fft.hpp"
#include "src/parallel/halo.hpp"

namespace barchan {

/// The constant-coefficient solve misses the few cells where c is far below one. Symmetric
/// multiplicative combination: relax the columns with grains (block Gauss-Seidel over columns, by
/// colours), solve globally for what is left, relax again in the reverse order. Symmetric and
/// positive definite in the volume-weighted inner product. It keeps nothing from step to step, so a
/// restarted run repeats the same bits.
class LocalCorrection {
 public:
  LocalCorrection(const Grid& grid, const Halo& halo);

  /// Finds the columns of the mobility c; to be called when c changed.
  void update(const FaceVector& c);

  /// z = M^-1 r; r changes and is as before on return.
  void apply(const PoissonFft& poisson, Field& r, Field& z);

 private:
  template <class Functor>
  void each_column(const char* label, const Functor& functor) const;
  void relax(const Field& r, Field& z, bool forward);
  static ColumnHeights heights(Field& f) { return {f}; }

  Grid grid_;
  Halo halo_;
  FaceVector c_;
  ColumnNeighbors neighbors_;
  Grid flat_;  // one row of cells
  Halo flat_halo_;
  Field found_, height_, around_;  // ColumnHeights: hindered; and one layer; and another
  Field pivot_, copy_;
  Field local_;  // zero between two calls of apply()
};

}  // namespace barchan
