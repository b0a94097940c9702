#include "src/fluid/local_correction.hpp"

namespace barchan {

namespace {

// Two solves leave 7e-7 of b around a dune of 1e5 grains. There three sweeps without
// over-relaxation, in the columns obstructed below 0.999, left 1e-5; the FFT alone needs 15 solves
// for 1e-6. Eight sweeps do without over-relaxation what five do with 1.35; 1.5 is no better.
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

void LocalCorrection::update(const FaceVector& c, const Region& near, const Field& workspace) {
  const Kokkos::DefaultExecutionSpace space;
  for (Field* mask : {&mask_, &mask_1_, &mask_2_}) Kokkos::deep_copy(space, mask->storage, Real(0));
  c_ = c, near_ = &near, workspace_ = workspace;
  bounds_ = near.columns().bounds();
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
      if (grid_.ranks) halo_.fill_between_ranks(z, bounds_);
      each_column("local: relax", RelaxColumns{.equations = {grid_, c_},
                                               .height = {mask_1_},
                                               .pivot = pivot_,
                                               .r = r,
                                               .z = z,
                                               .workspace = workspace_.storage.data(),
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

}  // namespace barchan
