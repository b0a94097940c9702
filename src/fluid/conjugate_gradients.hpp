// Preconditioned conjugate gradients for the pressure equation.
#pragma once

#include "src/fluid/local_correction.hpp"
#include "src/fluid/pressure_solver.hpp"
#include "src/parallel/cell_reductions.hpp"

namespace barchan {

/// With E the part of the operator that grains add, and P that of clear fluid: the guess is relaxed
/// near the grains, then gives P p = b - E p, which is solved directly, and this p is relaxed. What
/// is left of the equation lies near the grains alone, and so do the residuals of the conjugate
/// gradients that follow (iterations in a subspace: Kuznetsov, Proc. Int. Congr. Math. Warsaw 1983,
/// 1509).
///
/// As many iterations as the last solve took are launched without a look at the residual. Those
/// beyond its end change nothing, so their number changes no bit.
class ConjugateGradients : public PressureSolver {
 public:
  /// `relaxes`: with LocalCorrection around the direct solve.
  ConjugateGradients(const PressureProblem& problem, bool relaxes);

  PressureReport solve(const FaceVector& c, const Region& near, Field& b, Field& p) override;
  int reach() const override { return LocalCorrection::kReach; }

 private:
  PressureReport solve_clear(const Field& b, Field& p);
  void start(const FaceVector& c, Field& b, Field& p);
  void iterate(const FaceVector& c, Field& p, int n);
  void find_direction(Field& p, int n);
  template <class Functor>
  void launch_scalar_kernel(const char* label, const Functor& functor) const;
  void precondition();
  void fill_ghosts_near(Field& f) const;

  Grid grid_;
  Halo halo_;
  SolverConfig config_;
  bool relaxes_;
  int ahead_;
  PoissonFft poisson_;
  LocalCorrection local_;
  const Region* near_ = nullptr;  // of this solve
  int directions_before_ = 0;     // of the last solve
  DeviceReductions numbers_;      // GradientNumber
  Field r_;                       // residual, zero between solves and beyond near_
  Field z_, d_, e_;               // M^-1 r; direction; b, then A d
};

}  // namespace barchan
