#include "src/coupling/unresolved_exchange.hpp"

namespace barchan {

UnresolvedExchange::UnresolvedExchange(const FlowAndGrains& of, const GrainVolume& volume,
                                       bool layers)
    : grid_(of.config, of.solver, of.grid, of.grains.r_max, volume.points),
      fields_(of.solver, grid_, layers),
      gather_(of.config, of.grains, grid_, fields_, layers),
      deposit_(of.config, of.grains, grid_, fields_, volume.most) {}

void UnresolvedExchange::start(const GrainState& grains, FluidState& fluid) {
  deposit(grains, fluid, 0);
  Kokkos::deep_copy(fluid.alpha_f_previous.storage, fluid.alpha_f.storage);
  gather_.start();
}

void UnresolvedExchange::begin_gather(const FluidState& fluid, const GrainState& grains) {
  gather_.reserve_flow(grains);
  fields_.lend_to_gather();
  grid_.mark_columns_of(grains);
  mark_not_one(grid_.marks, CouplingGrid::kOfFraction, grid_.grid, fluid.alpha_f,
               fields_.of_flow.fraction.cells);  // it is one beyond
  grid_.marks.fetch();
  const ColumnMap of_grains = grid_.columns_of_grains();
  fields_.of_grains.set(of_grains);
  // The fraction is still one around grains that were fed since the last deposit.
  fields_.of_fraction.set(
      ColumnMap::marked(grid_.grid, grid_.marks, CouplingGrid::kOfFraction).united(of_grains));
  gather_.undo_smoothing(fluid);
}

ExchangeOfGrain UnresolvedExchange::begin_deposit(const GrainState& grains, Real dt) {
  const ExchangeOfGrain of_grain{.dt = dt,
                                 .grains = grains.kin,
                                 .on_grains = grains.fluid,
                                 .exchange = grains.exchange,
                                 .stresslet = gather_.stresslet()};
  deposit_.add_totals(of_grain, grains, sums_);
  return of_grain;
}

void UnresolvedExchange::end_deposit(Real dt) {
  fields_.give_back();
  ledger_ = sums_.ledger(ranks_of(grid_.grid), dt);
  ledger_.keeps_volume = deposit_.keeps_volume();
  // One row has no faces inside: the walls carry the vertical momentum.
  if (grid_.grid.ny == 1) ledger_.taken_from_fluid.y = ledger_.given_to_grains.y;
}

}  // namespace barchan
