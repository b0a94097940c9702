// A solver of the pressure equation -div(c grad p) = b, as the fluid step knows it.
#pragma once

#include <memory>

#include "kernels/math/on_host.hpp"
#include "src/fluid/fluid_case.hpp"
#include "src/fluid/poisson_fft.hpp"
#include "src/fluid/workspace.hpp"
#include "src/parallel/halo.hpp"
#include "src/parallel/region.hpp"

namespace barchan {

struct PressureReport {
  int iterations = 0;  // solves for clear fluid
  Real residual = 0;   // 2-norm over that of the right-hand side
};

/// c on faces in (0, 1], zero on walls: periodic in x and z, zero gradient at the walls, so p is
/// known up to a constant; it gets zero mean, and the mean of b, which no p can meet, is dropped.
class PressureSolver {
 public:
  virtual ~PressureSolver() = default;

  /// c is one beyond `near`, and only read there; at its sides c has periodic ghosts. b is
  /// overwritten; p holds the first guess, in `near` and the cells next to it, and becomes the
  /// solution, with ghosts in x and z. Stops at ||r|| <= pressure_tolerance ||b|| or after
  /// max_iterations solves for clear fluid. Where `near` is empty the solve is direct.
  virtual PressureReport solve(const FaceVector& c, const Region& near, Field& b, Field& p) = 0;

  /// Cells around those with obstructed faces, c < 1, that `near` must hold.
  virtual int reach() const = 0;
};

/// Parts that a solver is made of.
struct PressureProblem {
  const Grid& grid;
  const Halo& halo;
  std::shared_ptr<const PlaneFft> fft;
  const SolverConfig& config;
  const Workspace& workspace;   // its cells are the solver's during a solve
  int ahead = kOnHost ? 0 : 4;  // most iterations that may be launched before the host looks
};

/// Makes the solver that a case names.
std::unique_ptr<PressureSolver> make_pressure_solver(const PressureProblem& problem);

}  // namespace barchan
