// The pressure equation -div(c grad p) = b by preconditioned conjugate gradients.
#pragma once

#include <array>
#include <memory>

#include "kernels/fluid/column_relaxation.hpp"
#include "src/config/config.hpp"
#include "src/fluid/poisson_fft.hpp"
#include "src/parallel/halo.hpp"

namespace barchan {

/// Preconditioner where grains hinder the flow: the constant-coefficient solve misses the few cells
/// where c is far below one. Symmetric multiplicative combination: relax the columns with grains
/// (block Gauss-Seidel over columns, by colours), solve globally for what is left, relax again in
/// the reverse order. Symmetric and positive definite in the volume-weighted inner product. It
/// keeps nothing from step to step, so a restarted run repeats the same bits.
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

  Grid grid_;
  Halo halo_;
  FaceVector c_;
  Grid flat_;  // one row of cells
  Halo flat_halo_;
  Field mask_, mask_1_, mask_2_;  // ColumnHeights: obstructed; one layer more; two
  Field pivot_, saved_r_;
  Field local_;  // zero between two calls of apply()
};

struct PressureReport {
  int iterations = 0;
  Real residual = 0;  // 2-norm over that of the right-hand side
};

/// c on faces in (0, 1], zero on walls: periodic in x and z, zero gradient at the walls, so p is
/// known up to a constant; it gets zero mean, and the mean of b, which no p can meet, is dropped.
class PressureSolver {
 public:
  PressureSolver(const Grid& grid, const Halo& halo, std::shared_ptr<const PlaneFft> fft,
                 const SolverConfig& config);

  /// c with periodic ghosts; b is overwritten; p holds the first guess and becomes the solution,
  /// with ghosts in x and z. Stops at ||r|| <= tolerance ||b|| or after max_iterations.
  PressureReport solve(const FaceVector& c, Field& b, Field& p, Real tolerance);

  /// The same for c = 1, directly; the guess is not used.
  PressureReport solve_uniform(const Field& b, Field& p);

  /// Fields that hold nothing between two solves.
  std::array<Field, 3> scratch_fields() const { return {z_, d_, a_d_}; }

 private:
  void precondition();
  void remove_mean(Field& f);

  Grid grid_;
  Halo halo_;
  SolverConfig config_;
  PoissonFft poisson_;
  LocalCorrection local_;
  Field r_, z_, d_, a_d_;  // residual, M^-1 r, direction, A d
};

}  // namespace barchan
