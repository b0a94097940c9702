// The pressure equation -div(c grad p) = b by preconditioned conjugate gradients.
#pragma once

#include <array>

#include <memory>

#include "src/config/config.hpp"
#include "src/fluid/local_correction.hpp"
#include "src/fluid/poisson_fft.hpp"
#include "src/parallel/halo.hpp"

namespace barchan {

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

  /// In: c with periodic ghosts, p the first guess; b is overwritten. Out: p with ghosts in x, z.
  /// Stops at ||r|| <= tolerance ||b|| or after max_iterations.
  PressureReport solve(const FaceVector& c, const Field& b, const Field& p, Real tolerance);

  /// The same for c = 1, directly; the guess is not used.
  PressureReport solve_uniform(const Field& b, const Field& p);

  /// Fields that hold nothing between two solves.
  std::array<Field, 3> idle_fields() const { return {z_, direction_, image_}; }

 private:
  void precondition();
  void remove_mean(const Field& f);

  Grid grid_;
  Halo halo_;
  SolverConfig config_;
  PoissonFft poisson_;
  LocalCorrection local_;
  Field residual_, z_, direction_, image_;  // r, M^-1 r, d, A d
};

}  // namespace barchan
