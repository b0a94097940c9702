#include "src/coupling/deposit.hpp"

#include <utility>
#include <vector>

#include "src/parallel/reduce.hpp"

namespace barchan {

Deposit::Deposit(const Config& config, const GrainState& grains, const CouplingGrid& grid,
                 CouplingFields& fields)
    : config_(config.coupling),
      grid_(grid),
      fields_(fields),
      halo_(grid.grid, Deposits::kQuantities) {
  deposits_.sum = decltype(deposits_.sum)("deposits", CellIndex::count(grid.grid));
  deposits_.volume =
      fixed_point_for(static_cast<Real>(grains.n_initial) * sphere_volume(grains.r_max));
}

void Deposit::operator()(const GrainState& grains, FluidState& fluid, Real dt,
                         ExchangeLedger& ledger) {
  const ExchangeOfGrain of_grain{
      .dt = dt, .grains = grains.kin, .on_grains = grains.fluid, .exchange = grains.exchange};
  bound_sums(of_grain, grains.n, fluid, ledger);
  Kokkos::deep_copy(deposits_.sum, 0);
  using Launch = DepositGrains<kRunsOnHost ? 128 : 1>;
  Kokkos::parallel_for("coupling: deposit", items(Launch::items_for(grains.n)),
                       Launch{.of_grain = of_grain,
                              .by_row = exchange_by_row(fluid),
                              .deposits = deposits_,
                              .n = grains.n});
  halo_.scatter_add(deposits_.sum);
  update_fraction(fluid, ledger);
  spread_to_faces();
  ledger.taken_from_fluid = taken_from_fluid();
}

void Deposit::solid_of_momentum_cells(const GrainState& grains, const FluidState& fluid) {
  if (!grid_.crowded) return;
  Kokkos::deep_copy(deposits_.sum, 0);
  Kokkos::parallel_for("coupling: solid of momentum cells", items(grains.n),
                       DepositSolid{exchange_by_row(fluid), grains.kin, deposits_});
  halo_.scatter_add(deposits_.sum);
  for (const auto& [quantity, field] : {std::pair{Deposits::kSolidX, &fields_.solid_x},
                                        std::pair{Deposits::kSolidZ, &fields_.solid_z}}) {
    for_each_cell("coupling: solid of momentum cells", grid_.grid,
                  DecodeDeposit{.grid = grid_.grid,
                                .deposits = deposits_,
                                .point = deposits_.volume,
                                .quantity = quantity,
                                .density = *field});
    grid_.boundary.fill(*field, FieldKind::scalar);
  }
}

ExchangeByRow Deposit::exchange_by_row(const FluidState& fluid) const {
  return {.on = grid_.by_row,
          .stencil = grid_.stencil,
          .box = grid_.box,
          .u = fluid.u,
          .alpha_f = fields_.alpha_l(fluid)};
}

/// The fixed points: one cell can receive everything. And where the grains of all ranks are: a
/// neighbour's read from the outermost cells of this one.
void Deposit::bound_sums(const ExchangeOfGrain& of_grain, int n, const FluidState& fluid,
                         ExchangeLedger& ledger) {
  std::vector<Real> sum(6);
  Kokkos::parallel_reduce("coupling: totals", items(n), GrainTotals{of_grain}, sum[0], sum[1],
                          sum[2], sum[3], sum[4], sum[5], Kokkos::Min<Real>(extent_.left),
                          Kokkos::Max<Real>(extent_.right), Kokkos::Max<Real>(extent_.top),
                          Kokkos::Min<Real>(extent_.front), Kokkos::Max<Real>(extent_.back));
  const MPI_Comm ranks = ranks_of(grid_.grid);
  sum_over(ranks, sum);
  extent_ = {.left = -max_over(ranks, -extent_.left),
             .right = max_over(ranks, extent_.right),
             .top = max_over(ranks, extent_.top),
             .front = -max_over(ranks, -extent_.front),
             .back = max_over(ranks, extent_.back)};
  const Real volume = sum[0], beta_dt = sum[1], impulse = sum[2];
  deposits_.conductance = fixed_point_for(beta_dt * (kDividedOffsets * kDividedOffsets / 4));
  // Rows exchange no more than by twice the fastest velocity along x and z.
  const Real fastest = grid_.by_row
                           ? max_each_cell("coupling: fastest", grid_.grid, FastestAlong{fluid.u})
                           : Real(0);
  deposits_.impulse = fixed_point_for(impulse + 4 * fastest * beta_dt);
  ledger.grain_volume = volume;
  ledger.given_to_grains = {sum[3], sum[4], sum[5]};
}

void Deposit::update_fraction(FluidState& fluid, ExchangeLedger& ledger) {
  std::swap(fluid.alpha_f, fluid.alpha_f_previous);
  decode(Deposits::kVolume, deposits_.volume, fluid.alpha_f);
  ledger.deposited_volume = sum_each_cell("coupling: solid fraction to fluid fraction", grid_.grid,
                                          SolidToFluidFraction{grid_.grid, fluid.alpha_f});
  grid_.boundary.fill(fluid.alpha_f, FieldKind::scalar);
  if (!config_.alpha_time_derivative) {  // the fraction counts as if it had always been the new one
    Kokkos::deep_copy(fluid.alpha_f_previous.storage, fluid.alpha_f.storage);
  }
}

/// The exchange from the deposited impulse, and the conductances between rows.
void Deposit::spread_to_faces() {
  CellVector& impulse = fields_.impulse_in_cells;
  decode(Deposits::kImpulseX, deposits_.impulse, impulse.x);
  decode(Deposits::kImpulseY, deposits_.impulse, impulse.y);
  decode(Deposits::kImpulseZ, deposits_.impulse, impulse.z);
  if (!grid_.by_row) grid_.fill_ghosts(impulse);
  for_each_cell("coupling: spread to faces", grid_.grid,
                SpreadToFaces{.grid = grid_.grid,
                              .by_row = grid_.by_row,
                              .impulse_x = impulse.x,
                              .impulse_y = impulse.y,
                              .impulse_z = impulse.z,
                              .given = fields_.on_faces.impulse});
  if (!grid_.by_row) return;
  decode(Deposits::kConductanceX, deposits_.conductance, fields_.on_faces.conductance_x);
  decode(Deposits::kConductanceZ, deposits_.conductance, fields_.on_faces.conductance_z);
}

/// [N s]
Vec3 Deposit::taken_from_fluid() const {
  const FaceVector& impulse = fields_.on_faces.impulse;
  const auto sum = [&](const Field& component, bool y_faces) {
    return -sum_each_cell("ledger: taken from the fluid", grid_.grid,
                          SumImpulse{grid_.grid, y_faces, component});
  };
  return {sum(impulse.x, false), sum(impulse.y, true), sum(impulse.z, false)};
}

/// One quantity as a density in cells, smoothed.
void Deposit::decode(Deposits::Quantity quantity, const FixedPoint& point, Field& density) const {
  DecodeDeposit functor{.grid = grid_.grid,
                        .deposits = deposits_,
                        .point = point,
                        .quantity = quantity,
                        .density = density};
  if (quantity == Deposits::kVolume && config_.void_fraction == VoidFraction::cfdem_faithful) {
    functor.most = kMaxSolid;
  }
  for_each_cell("coupling: decode deposit", grid_.grid, functor);
  if (smooths(quantity)) grid_.smooth(density);
}

bool Deposit::smooths(Deposits::Quantity quantity) const {
  return grid_.smoothing_length > 0 &&
         (quantity == Deposits::kVolume || config_.exchange == Exchange::smoothed);
}

}  // namespace barchan
