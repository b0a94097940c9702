// The pressure equation -div(c grad p) = b by preconditioned conjugate gradients.
#pragma once

#include <array>
#include <memory>

#include "kernels/fluid/column_relaxation.hpp"
#include "src/fluid/fluid_case.hpp"
#include "src/fluid/poisson_fft.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "src/parallel/halo.hpp"

namespace barchan {

/// The solve looks at so many cells around those that have obstructed faces, with c < 1: relaxed
/// columns and what is left of the equation around them.
inline constexpr int kCellsAroundObstructed = 5;

/// Preconditioner where grains hinder the flow: the constant-coefficient solve misses the few cells
/// where c is far below one. Symmetric multiplicative combination: relax the columns with grains
/// (block SOR over columns, by colours), solve globally for what is left, relax again in
/// the reverse order. Symmetric and positive definite in the volume-weighted inner product. It
/// keeps nothing from step to step, so a restarted run repeats the same bits.
class LocalCorrection {
 public:
  LocalCorrection(const Grid& grid, const Halo& halo);

  /// Finds the columns of the mobility c within `near`, outside which c is one; to be called when c
  /// changed. `room`: a field whose values nobody needs while sweeps go on.
  void update(const FaceVector& c, const Region& near, const Field& room);
  void take_room(const Field& room) { room_ = room; }

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
  Grid flat_;  // one row of cells
  Halo flat_halo_;
  Field mask_, mask_1_, mask_2_;  // ColumnHeights: obstructed; one layer more; two
  Field pivot_, room_;
  Field local_;  // zero between two calls of apply()
};

struct PressureReport {
  int iterations = 0;  // solves for clear water
  Real residual = 0;   // 2-norm over that of the right-hand side
};

/// c on faces in (0, 1], zero on walls: periodic in x and z, zero gradient at the walls, so p is
/// known up to a constant; it gets zero mean, and the mean of b, which no p can meet, is dropped.
///
/// With E the part of the operator that grains add, and P that of clear water: the guess is relaxed
/// near the grains, then gives P p = b - E p, which is solved directly, and this p is relaxed. What
/// is left of the equation lies near the grains alone, and so do the residuals of the conjugate
/// gradients that follow (iterations in a subspace: Kuznetsov, Proc. Int. Congr. Math. Warsaw 1983,
/// 1509).
class PressureSolver {
 public:
  PressureSolver(const Grid& grid, const Halo& halo, std::shared_ptr<const PlaneFft> fft,
                 const SolverConfig& config);

  /// c is one beyond `near`, and only read there; at its sides c has periodic ghosts. b is
  /// overwritten; p holds the first guess, in `near` and the cells next to it, and becomes the
  /// solution, with ghosts in x and z. Stops at ||r|| <= tolerance ||b|| or after max_iterations
  /// solves for clear water.
  PressureReport solve(const FaceVector& c, const Region& near, Field& b, Field& p, Real tolerance);

  /// The same for c = 1, directly; the guess is not used.
  PressureReport solve_uniform(const Field& b, Field& p);

  /// Fields that hold nothing between two solves.
  std::array<Field, 3> scratch_fields() const { return {z_, d_, e_}; }

 private:
  void start(const FaceVector& c, Field& b, Field& p);
  void find_direction(Field& p, int iteration);
  template <class Functor>
  void launch_scalar_kernel(const char* label, const Functor& functor) const;
  void precondition();
  void fill_ghosts_near(Field& f) const;

  Grid grid_;
  Halo halo_;
  SolverConfig config_;
  PoissonFft poisson_;
  LocalCorrection local_;
  const Region* near_ = nullptr;  // of this solve
  DeviceReductions numbers_;      // GradientNumber
  Field r_, z_, d_, e_;           // residual, zero between solves and beyond near_; M^-1 r;
                                  // direction; b, then A d
};

}  // namespace barchan
