#include "src/fluid/pressure_solver.hpp"

#include <cmath>
#include <utility>

#include "kernels/fluid/conjugate_gradients.hpp"
#include "kernels/fluid/flow_sums.hpp"

namespace barchan {

namespace {

// Of a dune of 1e5 grains two solves leave 7e-7 of b, and three sweeps without over-relaxation, in
// the columns obstructed below 0.999, left 1e-5; the FFT alone needs 15 solves for 1e-6. Eight
// sweeps do without over-relaxation what five do with 1.35; 1.5 is no better.
constexpr int kSweeps = 5;
constexpr Real kOverRelaxation = 1.35;
constexpr Real kObstructedBelow = 0.99999;

Grid flat(Grid grid) {
  grid.ny = 1;
  return grid;
}

}  // namespace

LocalCorrection::LocalCorrection(const Grid& grid, const Halo& halo)
    : grid_(grid),
      halo_(halo),
      flat_(flat(grid)),
      flat_halo_(flat_),
      mask_("local: obstructed", flat_),
      mask_1_("local: columns", flat_),
      mask_2_("local: around", flat_),
      pivot_("local: pivot", grid),
      local_("local: correction", grid) {}

template <class Functor>
void LocalCorrection::each_column(const char* label, const Functor& functor) const {
  for_each_column(label, *near_, functor);
}

void LocalCorrection::update(const FaceVector& c, const Region& near, const Field& room) {
  const Kokkos::DefaultExecutionSpace space;
  for (Field* mask : {&mask_, &mask_1_, &mask_2_}) Kokkos::deep_copy(space, mask->storage, Real(0));
  c_ = c, near_ = &near, room_ = room;
  each_column("local: find columns", FindColumns{c, near.range().j1, kObstructedBelow, {mask_}});
  flat_halo_.fill(mask_);
  each_column("local: widen", WidenColumns{grid_.ny, {mask_}, {mask_1_}});
  flat_halo_.fill(mask_1_);
  each_column("local: widen", WidenColumns{grid_.ny, {mask_1_}, {mask_2_}});
  each_column("local: factorise", FactoriseColumn{{grid_, c}, {mask_1_}, pivot_});
}

void LocalCorrection::relax(const Field& r, Field& z, bool forward) {
  const int colours = ColumnNeighbors{grid_}.colours();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int n = 0; n < colours; ++n) {
      const int colour = forward ? n : colours - 1 - n;
      if (grid_.ranks) halo_.fill(z);  // the columns of other ranks
      each_column("local: relax", RelaxColumns{.equations = {grid_, c_},
                                               .height = {mask_1_},
                                               .pivot = pivot_,
                                               .r = r,
                                               .z = z,
                                               .room = room_.storage.data(),
                                               .over = kOverRelaxation,
                                               .colour = colour});
    }
  }
}

void LocalCorrection::apply(const PoissonFft& poisson, Field& r, Field& z, Field& copy_of_r) {
  relax(r, local_, true);
  if (near_->has_ghosts()) halo_.fill(local_);
  each_column("local: subtract", SubtractLocal{grid_, c_, {mask_2_}, local_, r, copy_of_r});
  poisson.solve(r, z);
  each_column("local: add", AddLocal{{mask_2_}, copy_of_r, local_, r, z});
  relax(r, z, false);
}

PressureSolver::PressureSolver(const Grid& grid, const Halo& halo,
                               std::shared_ptr<const PlaneFft> fft, const SolverConfig& config)
    : grid_(grid),
      halo_(halo),
      config_(config),
      poisson_(grid, std::move(fft), 0, 1),
      local_(grid, halo),
      numbers_("pressure: numbers", kGradientNumbers),
      r_("pressure: residual", grid),
      z_("pressure: z", grid),
      d_("pressure: direction", grid),
      e_("pressure: image", grid) {}

void PressureSolver::fill_ghosts_near(Field& f) const {
  if (near_->has_ghosts()) halo_.fill(f);
}

/// z = M^-1 r.
void PressureSolver::precondition() {
  if (config_.preconditioner.is<RelaxedFft>()) {
    local_.apply(poisson_, r_, z_, e_);
  } else {
    poisson_.solve(r_, z_);
  }
}

/// A few numbers from others, on the device.
template <class Functor>
void PressureSolver::launch_scalar_kernel(const char* label, const Functor& functor) const {
  Kokkos::parallel_for(label, items(1), functor);
}

/// P p = b - E (the relaxed guess), relaxed; r = b - A p.
void PressureSolver::start(const FaceVector& c, Field& b, Field& p) {
  const bool relaxes = config_.preconditioner.is<RelaxedFft>();
  const MPI_Comm ranks = ranks_of(grid_);
  fill_ghosts_near(p);
  if (relaxes) {
    local_.relax(b, p, true);
    fill_ghosts_near(p);
  }
  const NormAndMean norm{grid_, b};
  sum_vector("pressure: clear water", numbers_, kNormOfB, owned_cells(grid_),
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
  if (relaxes) {
    mean_of_p(kSumOfP);
    local_.relax(e_, p, false);
    mean_of_p(kSumOfRelaxed);
    fill_ghosts_near(p);
  }
  sum_each_cell("pressure: residual", numbers_, kRR, *near_, Residual{grid_, c, p, e_, r_});
  numbers_.combine(ranks, kSumOfP, 3, MPI_SUM);
  launch_scalar_kernel("pressure: mean of p",
                       FindSurplus{numbers_.data(), grid_.height_of_all_columns()});
}

/// d from z; before, p goes along the last one.
void PressureSolver::find_direction(Field& p, int iteration) {
  if (iteration == 1) {
    std::swap(z_, d_);
    return sum_each_cell("pressure: mean", numbers_, kSumOfD, owned_cells(grid_),
                         HeightSum{grid_, d_});
  }
  const DeviceScalar a = numbers_.scalar(kA), surplus = numbers_.scalar(kSurplus);
  launch_scalar_kernel("pressure: beta", FindBeta{numbers_.data()});
  sum_each_cell("pressure: direction", numbers_, kSumOfD, owned_cells(grid_),
                NextDirection{grid_, {d_, p, a, surplus}, z_, numbers_.scalar(kBeta), d_});
}

PressureReport PressureSolver::solve(const FaceVector& c, const Region& near, Field& b, Field& p,
                                     Real tolerance) {
  near_ = &near;
  const MPI_Comm ranks = ranks_of(grid_);
  if (config_.preconditioner.is<RelaxedFft>()) local_.update(c, near, z_);
  start(c, b, p);
  local_.take_room(b);  // which is no longer needed
  numbers_.fetch();
  const Real norm_of_b = numbers_.get(kNormOfB) - numbers_.get(kSumOfB) * numbers_.get(kMeanOfB);
  const Real enough = tolerance * tolerance * norm_of_b;
  PressureReport report{.iterations = 1};
  for (; numbers_.get(kRR) > enough && report.iterations < config_.max_iterations;
       ++report.iterations) {
    precondition();
    sum_each_cell("pressure: <r, z>", numbers_, kRZ, *near_, InnerProduct{grid_, r_, z_});
    numbers_.combine(ranks, kRZ, 1, MPI_SUM);
    find_direction(p, report.iterations);
    fill_ghosts_near(d_);
    sum_each_cell("pressure: operator", numbers_, kCurvature, *near_,
                  ApplyOperator{grid_, c, d_, e_});
    numbers_.combine(ranks, kCurvature, 2, MPI_SUM);
    launch_scalar_kernel("pressure: step", FindStep{numbers_.data(), grid_.height_of_all_columns(),
                                                    report.iterations == 1});
    sum_each_cell("pressure: advance", numbers_, kRR, *near_,
                  AdvanceResidual{grid_, e_, r_, numbers_.scalar(kA)});
    numbers_.combine(ranks, kRR, 1, MPI_SUM);
    numbers_.fetch();
  }
  const DeviceScalar surplus = numbers_.scalar(kSurplus);
  if (report.iterations > 1) {
    for_each_cell("pressure: advance", grid_, AdvancePressure{d_, p, numbers_.scalar(kA), surplus});
  } else {
    for_each_cell("pressure: remove mean", grid_, Subtract{p, surplus});
  }
  for_each_cell("pressure: clear", near, SetZero{r_});
  report.residual = norm_of_b > 0 ? std::sqrt(numbers_.get(kRR) / norm_of_b) : 0;
  halo_.fill(p);
  return report;
}

PressureReport PressureSolver::solve_uniform(const Field& b, Field& p) {
  poisson_.solve(b, p);
  halo_.fill(p);
  return {.iterations = 1, .residual = 0};
}

}  // namespace barchan
