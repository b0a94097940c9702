#include "src/coupling/coupling.hpp"

namespace barchan {

Coupling::Coupling(const Config& config, const FluidSolver& solver, const GrainState& grains,
                   const Grid& grid)
    : keeps_volume_(config.coupling.void_fraction != VoidFraction::cfdem_faithful),
      grid_(config, solver, grid, grains.r_max),
      fields_(solver, grid_),
      gather_(config, grains, grid_, fields_),
      deposit_(config, grains, grid_, fields_) {}

void Coupling::start(const GrainState& grains, FluidState& fluid) {
  deposit(grains, fluid, 0);
  Kokkos::deep_copy(fluid.alpha_f_previous.storage, fluid.alpha_f.storage);
  gather_.start();
}

void Coupling::gather(const FluidState& fluid, GrainState& grains, Real dt) {
  fields_.lend_to_gather();
  grid_.mark_columns_of(grains);
  grid_.marks.mark_not_one(CouplingGrid::kOfFraction, grid_.grid, fluid.alpha_f);
  grid_.marks.fetch();
  const ColumnMap of_grains = grid_.columns_of_grains();
  fields_.of_grains.set(of_grains);
  // Around grains that were fed since the last deposit the fraction is still one.
  fields_.of_fraction.set(
      ColumnMap::marked(grid_.grid, grid_.marks, CouplingGrid::kOfFraction).united(of_grains));
  gather_.undo_smoothing(fluid);
  deposit_.solid_of_momentum_cells(grains, fluid);
  gather_(fluid, grains, dt, sums_);
}

void Coupling::deposit(const GrainState& grains, FluidState& fluid, Real dt) {
  deposit_(grains, fluid, dt, sums_);
  ledger_ = sums_.ledger(ranks_of(grid_.grid), dt);
  ledger_.keeps_volume = keeps_volume_;
  // One row has no faces inside: what goes upwards is carried by the walls.
  if (grid_.grid.ny == 1) ledger_.taken_from_fluid.y = ledger_.given_to_grains.y;
}

}  // namespace barchan
