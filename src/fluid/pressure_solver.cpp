#include "src/fluid/pressure_solver.hpp"

#include <cmath>
#include <utility>

#include "src/parallel/reduce.hpp"

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
  for (Field* mask : {&mask_, &mask_1_, &mask_2_}) Kokkos::deep_copy(mask->storage, Real(0));
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
      r_("pressure: residual", grid),
      z_("pressure: z", grid),
      d_("pressure: direction", grid),
      e_("pressure: image", grid) {}

/// What the cells near grains add to the mean of all.
Real PressureSolver::near_mean(const Field& f) const {
  return sum_each_cell("pressure: mean", grid_, *near_, HeightSum{grid_, f}) /
         grid_.height_of_all_columns();
}

void PressureSolver::fill_ghosts_near(Field& f) const {
  if (near_->has_ghosts()) halo_.fill(f);
}

/// z = M^-1 r.
void PressureSolver::precondition() {
  if (config_.preconditioner == Preconditioner::local_fft) {
    local_.apply(poisson_, r_, z_, e_);
  } else {
    poisson_.solve(r_, z_);
  }
}

/// P p = b - E (the relaxed guess), relaxed; r = b - A p.
PressureSolver::Start PressureSolver::start(const FaceVector& c, Field& b, Field& p) {
  const bool relaxes = config_.preconditioner == Preconditioner::local_fft;
  fill_ghosts_near(p);
  if (relaxes) {
    local_.relax(b, p, true);
    fill_ghosts_near(p);
  }
  const NormAndMean norm{grid_, b};
  const Vec3 sums =
      sum_vector("pressure: clear water", grid_, owned_cells(grid_),
                 ByRegion{near_->ref(), SubtractObstruction{norm, c, p, b, e_}, norm});
  const Real mean_of_b = sums.y / grid_.height_of_all_columns();
  poisson_.solve(b, p);
  for_each_cell("pressure: mean", *near_, Subtract{e_, mean_of_b});
  fill_ghosts_near(p);
  Real mean_of_p = 0;
  if (relaxes) {
    mean_of_p = -near_mean(p);
    local_.relax(e_, p, false);
    mean_of_p += near_mean(p);
    fill_ghosts_near(p);
  }
  const Real rr = sum_each_cell("pressure: residual", grid_, *near_, Residual{grid_, c, p, e_, r_});
  return {sums.x - sums.y * mean_of_b, rr, mean_of_p};
}

PressureReport PressureSolver::solve(const FaceVector& c, const Region& near, Field& b, Field& p,
                                     Real tolerance) {
  near_ = &near;
  if (config_.preconditioner == Preconditioner::local_fft) local_.update(c, near, z_);
  const Start first = start(c, b, p);
  local_.take_room(b);  // which is no longer needed
  const Real enough = tolerance * tolerance * first.norm_of_b;
  const Real height = grid_.height_of_all_columns();
  PressureReport report{.iterations = 1};
  Real rr = first.norm_of_r, rz_before = 0;
  Real a = 0, mean_of_d = 0, surplus = first.mean_of_p;  // p + a d - surplus is the next p
  for (; rr > enough && report.iterations < config_.max_iterations; ++report.iterations) {
    precondition();
    const Real rz = sum_each_cell("pressure: <r, z>", grid_, *near_, InnerProduct{grid_, r_, z_});
    if (report.iterations == 1) {
      std::swap(z_, d_);
      mean_of_d = sum_each_cell("pressure: mean", grid_, HeightSum{grid_, d_}) / height;
    } else {
      const NextDirection next{grid_, {d_, p, a, surplus}, z_, rz / rz_before, d_};
      mean_of_d = sum_each_cell("pressure: direction", grid_, next) / height;
      surplus = 0;
    }
    fill_ghosts_near(d_);
    const Real curvature =
        sum_each_cell("pressure: operator", grid_, *near_, ApplyOperator{grid_, c, d_, e_});
    a = rz / curvature;
    surplus += a * mean_of_d;
    rr = sum_each_cell("pressure: advance", grid_, *near_, AdvanceResidual{grid_, e_, r_, a});
    rz_before = rz;
  }
  if (report.iterations > 1) {
    for_each_cell("pressure: advance", grid_, AdvancePressure{d_, p, a, surplus});
  } else {
    for_each_cell("pressure: remove mean", grid_, Subtract{p, surplus});
  }
  for_each_cell("pressure: clear", near, SetZero{r_});
  report.residual = first.norm_of_b > 0 ? std::sqrt(rr / first.norm_of_b) : 0;
  halo_.fill(p);
  return report;
}

PressureReport PressureSolver::solve_uniform(const Field& b, Field& p) {
  poisson_.solve(b, p);
  halo_.fill(p);
  return {.iterations = 1, .residual = 0};
}

}  // namespace barchan
