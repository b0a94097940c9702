// Pressure and correction of the fluid step, and its report.
#include <utility>

#include "kernels/fluid/field_algebra.hpp"
#include "src/base/stopwatch.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/parallel/cell_reductions.hpp"

namespace barchan {

template <Fraction fraction>
PressureSource<fraction> FluidSolver::pressure_source(const FaceVector& u, const FluidState& fluid,
                                                      Real drive_x, Real dt) {
  return {.grid = grid_,
          .u = u,
          .alpha = fluid.alpha_f,
          .alpha_before = fluid.alpha_f_previous,
          .c = mobility_,
          .drive_dt = drive_x * dt,
          .density = config_.density,
          .dt = dt,
          .b = source_};
}

/// Total pressure: every step solves for all of it. p_previous becomes the last one.
void FluidSolver::solve_pressure(FluidState& fluid, Real dt) {
  const ScopedSeconds timer(report_.seconds_pressure);
  FaceVector& u_star = workspace_.u_star;
  std::swap(fluid.p, fluid.p_previous);
  const Real last = fluid.has_history ? 2 : 1, before = fluid.has_history ? -1 : 0;
  for_each_cell("fluid: extrapolate pressure", regions_->fraction.dilated,
                Axpby{last, fluid.p_previous, before, fluid.p});
  boundary_.halo().fill(u_star.x, u_star.z);
  for_each_cell("fluid: pressure source", grid_,
                by_region(pressure_source<Fraction::variable>(u_star, fluid, fluid.drive.x, dt),
                          pressure_source<Fraction::uniform>(u_star, fluid, fluid.drive.x, dt)));
  for (const auto& term : terms_) term->constrain_pressure(source_, numbers_);
  const PressureReport solved =
      pressure_->solve(mobility_, regions_->fraction.cells, source_, fluid.p);
  for (const auto& term : terms_) term->constrain_pressure(fluid.p, numbers_);
  boundary_.fill(fluid.p, FieldKind::scalar);
  report_.pressure_iterations = solved.iterations;
  report_.pressure_residual = solved.residual;
}

template <Fraction fraction>
CorrectVelocity<fraction> FluidSolver::correction(FluidState& fluid, Real dt) {
  return {.grid = grid_,
          .u_star = workspace_.u_star,
          .p = fluid.p,
          .alpha = fluid.alpha_f,
          .c = mobility_,
          .inv_density = 1 / config_.density,
          .drive_dt = fluid.drive.x * dt,
          .dt = dt,
          .u = fluid.u,
          .du_dt = fluid.du_dt};
}

void FluidSolver::correct(FluidState& fluid, Real dt) {
  largest_and_sums("fluid: correct velocity", numbers_, kCourant, owned_cells(grid_),
                   by_region(correction<Fraction::variable>(fluid, dt),
                             correction<Fraction::uniform>(fluid, dt)));
  boundary_.fill_velocity(fluid.u);
  if (fraction_varies_) boundary_.fill_acceleration(fluid.du_dt);  // the exchange reads ghosts
}

/// Numbers of the report, and by how much the projection missed the wanted flow rate.
void FluidSolver::measure(FluidState& fluid, Real dt) {
  const ContinuityResidual near{pressure_source<Fraction::variable>(fluid.u, fluid, 0, dt)};
  const ContinuityResidual clear{pressure_source<Fraction::uniform>(fluid.u, fluid, 0, dt)};
  max_each_cell("fluid: continuity", numbers_, kContinuity, owned_cells(grid_),
                by_region(near, clear));
  for (const auto& term : terms_) term->after_correct(step(fluid, dt));
  numbers_.combine(ranks_of(grid_), kContinuity, 2, MPI_MAX);
  numbers_.combine(ranks_of(grid_), kNewRate, 2, MPI_SUM);
  numbers_.fetch();
  for (const auto& term : terms_) term->report(numbers_);
  report_.continuity_residual = numbers_.get(kContinuity);
  report_.courant = numbers_.get(kCourant);
  if (!fraction_varies_) return;
  const Vec2 flow{numbers_.get(kNewRate), drive_.along_z() ? numbers_.get(kNewRate + 1) : 0};
  fluid.flow_rate_defect = {flow_.rate.x - flow.x, flow_.rate.z - flow.z};
  report_.bulk_velocity = {flow.x / flow_.height, flow.z / flow_.height};
}

}  // namespace barchan
