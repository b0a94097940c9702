#include "src/fluid/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/fluid/conjugate_gradients.hpp"
#include "kernels/fluid/field_algebra.hpp"
#include "kernels/fluid/flow_sums.hpp"

namespace barchan {

ConjugateGradients::ConjugateGradients(const PressureProblem& problem, bool relaxes)
    : grid_(problem.grid),
      halo_(problem.halo),
      config_(problem.config),
      relaxes_(relaxes),
      ahead_(problem.ahead),
      poisson_(grid_, problem.fft, 0, 1),
      local_(grid_, halo_),
      numbers_("pressure: numbers", kGradientNumbers),
      r_("pressure: residual", grid_),
      z_(problem.workspace.cells[0]),
      d_(problem.workspace.cells[1]),
      e_(problem.workspace.cells[2]) {}

void ConjugateGradients::fill_ghosts_near(Field& f) const {
  if (near_->has_ghosts()) halo_.fill(f);
}

/// z = M^-1 r.
void ConjugateGradients::precondition() {
  if (relaxes_) {
    local_.apply(poisson_, r_, z_, e_);
  } else {
    poisson_.solve(r_, z_);
  }
}

/// A few numbers from others, on the device.
template <class Functor>
void ConjugateGradients::launch_scalar_kernel(const char* label, const Functor& functor) const {
  Kokkos::parallel_for(label, items(1), functor);
}

/// P p = b - E (the relaxed guess), relaxed; r = b - A p.
void ConjugateGradients::start(const FaceVector& c, Field& b, Field& p) {
  const MPI_Comm ranks = ranks_of(grid_);
  fill_ghosts_near(p);
  if (relaxes_) {
    local_.relax(b, p, true);
    fill_ghosts_near(p);
  }
  const NormAndMean norm{grid_, b};
  sum_vector("pressure: clear fluid", numbers_, kNormOfB, owned_cells(grid_),
             ByRegion{near_->ref(), SubtractObstruction{norm, c, p, b, e_}, norm});
  numbers_.combine(ranks, kNormOfB, 2, MPI_SUM);
  launch_scalar_kernel("pressure: mean of b",
                       FindMeanOfB{numbers_.data(), grid_.height_of_all_columns()});
  poisson_.solve(b, p);
  for_each_cell("pressure: mean", *near_, Subtract{e_, numbers_.scalar(kMeanOfB)});
  fill_ghosts_near(p);
  const auto mean_of_p = [&](int slot) {
    sum_each_cell("pressure: mean", numbers_, slot, *near_, HeightSum{grid_, p});
  };
  if (relaxes_) {
    mean_of_p(kSumOfP);
    local_.relax(e_, p, false);
    mean_of_p(kSumOfRelaxed);
    fill_ghosts_near(p);
  }
  sum_each_cell("pressure: residual", numbers_, kRR, *near_, Residual{grid_, c, p, e_, r_});
  numbers_.combine(ranks, kSumOfP, 3, MPI_SUM);
  launch_scalar_kernel("pressure: mean of p",
                       FindSurplus{numbers_.data(),
                                   grid_.height_of_all_columns(),
                                   {numbers_.data(), config_.pressure_tolerance}});
}

/// d from z; before, p goes along the last one.
void ConjugateGradients::find_direction(Field& p, int n) {
  if (n == 1) {
    std::swap(z_, d_);
    return sum_each_cell("pressure: mean", numbers_, kSumOfD, owned_cells(grid_),
                         HeightSum{grid_, d_});
  }
  launch_scalar_kernel("pressure: beta", FindBeta{numbers_.data()});
  const AdvancePressure advance{d_, p, numbers_.scalar(kPending), numbers_.scalar(kPendingSurplus)};
  sum_each_cell(
      "pressure: direction", numbers_, kSumOfD, owned_cells(grid_),
      NextDirection{grid_, advance, z_, numbers_.scalar(kKeep), numbers_.scalar(kBeta), d_});
}

PressureReport ConjugateGradients::solve(const FaceVector& c, const Region& near, Field& b,
                                         Field& p) {
  if (near.columns().is_empty()) return solve_clear(b, p);
  near_ = &near;
  if (relaxes_) local_.update(c, near, z_);
  start(c, b, p);
  local_.set_workspace(b);  // which is no longer needed
  const int most = config_.max_iterations - 1;
  const int ahead = std::min({directions_before_, ahead_, most});
  for (int n = 1; n <= ahead; ++n) iterate(c, p, n);
  numbers_.fetch();
  for (int n = ahead + 1; n <= most && numbers_.get(kGoesOn) != 0; ++n) {
    iterate(c, p, n);
    numbers_.fetch();
  }
  directions_before_ = static_cast<int>(numbers_.get(kDirections));
  const DeviceScalar surplus = numbers_.scalar(kSurplus);
  if (directions_before_ > 0) {
    for_each_cell("pressure: advance", grid_, AdvancePressure{d_, p, numbers_.scalar(kA), surplus});
  } else {
    for_each_cell("pressure: remove mean", grid_, Subtract{p, surplus});
  }
  for_each_cell("pressure: clear", near, SetZero{r_});
  halo_.fill(p);
  const Real norm_of_b = numbers_.get(kNormOfB) - numbers_.get(kSumOfB) * numbers_.get(kMeanOfB);
  return {.iterations = 1 + directions_before_,
          .residual = norm_of_b > 0 ? std::sqrt(numbers_.get(kRR) / norm_of_b) : 0};
}

/// One direction d and the residual after it; n counts from 1.
void ConjugateGradients::iterate(const FaceVector& c, Field& p, int n) {
  const MPI_Comm ranks = ranks_of(grid_);
  precondition();
  sum_each_cell("pressure: <r, z>", numbers_, kRZ, *near_, InnerProduct{grid_, r_, z_});
  numbers_.combine(ranks, kRZ, 1, MPI_SUM);
  find_direction(p, n);
  fill_ghosts_near(d_);
  sum_each_cell("pressure: operator", numbers_, kCurvature, *near_,
                ApplyOperator{grid_, c, d_, e_});
  numbers_.combine(ranks, kCurvature, 2, MPI_SUM);
  launch_scalar_kernel("pressure: step",
                       FindStep{numbers_.data(), grid_.height_of_all_columns(), n == 1});
  sum_each_cell("pressure: advance", numbers_, kRR, *near_,
                AdvanceResidual{grid_, e_, r_, numbers_.scalar(kStep)});
  numbers_.combine(ranks, kRR, 1, MPI_SUM);
  launch_scalar_kernel("pressure: whether done", FindWhetherDone{numbers_.data()});
}

PressureReport ConjugateGradients::solve_clear(const Field& b, Field& p) {
  poisson_.solve(b, p);
  halo_.fill(p);
  return {.iterations = 1, .residual = 0};
}

}  // namespace barchan
