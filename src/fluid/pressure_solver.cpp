#include "src/fluid/pressure_solver.hpp"

#include <cmath>
#include <utility>

#include "kernels/fluid/pressure.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

PressureSolver::PressureSolver(const Grid& grid, const Halo& halo,
                               std::shared_ptr<const PlaneFft> fft, const SolverConfig& config)
    : grid_(grid),
      halo_(halo),
      config_(config),
      poisson_(grid, std::move(fft), 0, 1),
      local_(grid, halo),
      z_("pressure: z", grid),
      direction_("pressure: direction", grid),
      image_("pressure: image", grid) {}

void PressureSolver::remove_mean(Field& f) {
  const Real height = grid_.height_of_all_columns();
  const Real mean = sum_each_cell("pressure: mean", grid_, HeightSum{grid_, f}) / height;
  for_each_cell("pressure: remove mean", grid_, Subtract{f, mean});
}

/// z = M^-1 r.
void PressureSolver::precondition() {
  if (config_.preconditioner == Preconditioner::local_fft) {
    local_.apply(poisson_, residual_, z_);
  } else {
    poisson_.solve(residual_, z_);
  }
}

PressureReport PressureSolver::solve(const FaceVector& c, Field& b, Field& p, Real tolerance) {
  remove_mean(b);
  residual_ = b;
  if (config_.preconditioner == Preconditioner::local_fft) local_.update(c);
  const Real bb = sum_each_cell("pressure: norm of b", grid_, InnerProduct{grid_, b, b});
  halo_.fill(p);
  Real rr = sum_each_cell("pressure: residual", grid_, InitialResidual{grid_, c, p, residual_});
  const Real enough = tolerance * tolerance * bb;
  Real rz_before = 0;
  PressureReport report;
  while (rr > enough && report.iterations < config_.max_iterations) {
    precondition();
    const Real rz = sum_each_cell("pressure: <r, z>", grid_, InnerProduct{grid_, residual_, z_});
    const Real b_factor = rz_before == 0 ? 0 : rz / rz_before;
    for_each_cell("pressure: direction", grid_, Combine{1, z_, b_factor, direction_});
    halo_.fill(direction_);
    const Real curvature =
        sum_each_cell("pressure: operator", grid_, ApplyOperator{grid_, c, direction_, image_});
    const Real a = rz / curvature;
    rr = sum_each_cell("pressure: advance", grid_,
                       AdvanceIterate{grid_, direction_, image_, p, residual_, a});
    rz_before = rz;
    ++report.iterations;
  }
  report.residual = bb > 0 ? std::sqrt(rr / bb) : 0;
  remove_mean(p);
  halo_.fill(p);
  return report;
}

PressureReport PressureSolver::solve_uniform(const Field& b, Field& p) {
  poisson_.solve(b, p);
  halo_.fill(p);
  return {.iterations = 1, .residual = 0};
}

}  // namespace barchan
