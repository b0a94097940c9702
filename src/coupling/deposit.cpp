#include "src/coupling/deposit.hpp"

#include <algorithm>
#include <utility>

#include "kernels/grains/sphere.hpp"
#include "src/parallel/poison.hpp"
#include "src/parallel/tally_cells.hpp"

namespace barchan {

namespace {

/// Cells around those that grains' volume is spread over: their faces, and the columns that the
/// pressure equation relaxes. These reach four cells beyond what is obstructed by more than 1e-5,
/// which ends where less than half of the twelve digits has decayed (LocalCorrection).
int cells_around(int reach) { return 1 + std::max(0, kCellsAroundObstructed - reach / 2); }

/// Elsewhere than in a region the fraction before the smoothing is one.
struct OneBeyond {
  RegionRef region;
  FieldRef fraction;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    fraction(i, j, k) = region.has(i, j, k) ? fraction(i, j, k) : Real(1);
  }
};

/// Beyond the cells that grains give to there are no sums.
struct ZeroBeyond {
  RegionRef deposited;
  DecodeDeposit decode;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    if (deposited.has(i, j, k)) {
      decode(i, j, k);
    } else {
      decode.density(i, j, k) = 0;
    }
  }
};

/// However many grains come in, they do not fit into more than the cell and a grain around it
/// [m^3].
Real largest_of_cell(const Grid& grid, Real r_max) {
  const Real around = 4 * r_max;
  return (grid.dx + around) * (grid.ly + around) * (grid.dz + around);
}

}  // namespace

Deposit::Deposit(const Config& config, const GrainState& grains, const CouplingGrid& grid,
                 CouplingFields& fields)
    : config_(config.coupling),
      grid_(grid),
      fields_(fields),
      halo_(grid.grid, Deposits::kQuantities) {
  deposits_.sum = decltype(deposits_.sum)("deposits", CellIndex::count(grid.grid));
  Real largest = static_cast<Real>(grains.n_initial) * sphere_volume(grains.r_max);
  if (config.grains->feed) largest = std::max(largest, largest_of_cell(grid.grid, grains.r_max));
  deposits_.volume = fixed_point_for(largest);
}

void Deposit::operator()(const GrainState& grains, FluidState& fluid, Real dt,
                         const ExchangeSums& sums) {
  const ExchangeOfGrain of_grain{
      .dt = dt, .grains = grains.kin, .on_grains = grains.fluid, .exchange = grains.exchange};
  add_totals(of_grain, grains, fluid, sums);
  find_cells();
  bound_sums(sums);
  fields_.lend_to_deposit();
  clear(fields_.deposited);
  using Launch = DepositGrains<kOnHost ? 128 : 1>;
  Kokkos::parallel_for("coupling: deposit", items(Launch::items_for(grains.n)),
                       Launch{.of_grain = of_grain,
                              .by_row = exchange_by_row(fluid),
                              .deposits = deposits_,
                              .n = grains.n});
  halo_.scatter_add(deposits_.sum);
  update_fraction(fluid, sums);
  if (grid_.by_row) {
    rows_to_faces(sums);
  } else {
    spread_to_faces(sums);
  }
  fields_.give_back();
}

void Deposit::solid_of_momentum_cells(const GrainState& grains, const FluidState& fluid) {
  if (!grid_.crowded) return;
  const Region& cells = fields_.of_grains.around;
  clear(cells);
  Kokkos::parallel_for("coupling: solid of momentum cells", items(grains.n),
                       DepositSolid{exchange_by_row(fluid), grains.kin, deposits_});
  halo_.scatter_add(deposits_.sum);
  for (const auto& [quantity, field] : {std::pair{Deposits::kSolidX, &fields_.solid_x},
                                        std::pair{Deposits::kSolidZ, &fields_.solid_z}}) {
    decode(quantity, deposits_.volume, cells, cells, *field);
  }
  grid_.boundary.fill_scalars(cells, fields_.solid_x, fields_.solid_z);
}

/// Where the sums are zero that grains are then added to; the ghosts are added to their owners.
void Deposit::clear(const Region& cells) {
  poison(deposits_.sum);
  const Grid& grid = grid_.grid;
  const ClearDeposits set_zero{grid, deposits_};
  for_each_cell("coupling: clear deposits", cells, set_zero);
  if (grid.ranks == nullptr) return;
  for (const int i : {-1, grid.nx})
    for_each_cell("coupling: clear deposits", {i, i + 1, 0, grid.ny, -1, grid.nz + 1}, set_zero);
  for (const int k : {-1, grid.nz})
    for_each_cell("coupling: clear deposits", {-1, grid.nx + 1, 0, grid.ny, k, k + 1}, set_zero);
}

ExchangeByRow Deposit::exchange_by_row(const FluidState& fluid) const {
  return {.on = grid_.by_row,
          .stencil = grid_.stencil,
          .box = grid_.box,
          .u = fluid.u,
          .alpha_f = fields_.alpha_l(fluid)};
}

/// Where the grains are, what of their volume the smoothing spreads, and what the flow has to know.
void Deposit::find_cells() {
  const int reach = grid_.smoother.reach();
  const ColumnMap of_grains = grid_.columns_of_grains();
  ColumnMap smoothed = of_grains.grown(reach);
  smoothed.set_top(grid_.smoother.top_above(of_grains.top()));
  fields_.smoothed.set(smoothed);
  const ColumnMap of_flow = smoothed.united(fields_.of_fraction.cells.columns())
                                .grown(cells_around(reach))
                                .in_blocks()
                                .united(grid_.bodies ? grid_.bodies->columns() : ColumnMap{});
  fields_.of_flow.fraction.set(of_flow);
  const ColumnMap deposited = of_grains.grown(1).in_blocks();
  fields_.deposited.set(deposited);
  fields_.of_flow.exchange.set(config_.exchange == Exchange::smoothed ? of_flow : deposited);
  if (!grid_.by_row) fields_.of_impulse.set(fields_.of_flow.exchange.columns().grown(1));
  if (grid_.smoothing_length == 0) return;
  Field& before_smoothing = fields_.alpha_before_smoothing;
  const Region& around = fields_.of_flow.fraction.around;  // of whose faces both sides are read
  for_each_cell("coupling: fraction before smoothing", around,
                OneBeyond{fields_.of_fraction.around.ref(), before_smoothing});
  grid_.boundary.fill_scalars(around, before_smoothing);
}

/// The columns of the grains and what they give, for the host.
void Deposit::add_totals(const ExchangeOfGrain& of_grain, const GrainState& grains,
                         const FluidState& fluid, const ExchangeSums& sums) {
  grid_.mark_columns_of(grains);
  Kokkos::parallel_reduce("coupling: totals", items(grains.n), AddTotals{of_grain},
                          sums.into<GrainTotals>(ExchangeSums::kTotals));
  if (grid_.by_row)
    max_each_cell("coupling: fastest", sums, ExchangeSums::kFastest, owned_cells(grid_.grid),
                  FastestAlong{fluid.u});
  sums.combine_totals(ranks_of(grid_.grid));
  grid_.marks.copy_to_host();
  sums.copy_to_host();
  Kokkos::fence("coupling: columns and totals");
}

/// The fixed points: one cell can receive everything.
void Deposit::bound_sums(const ExchangeSums& sums) {
  const auto totals = sums.get<GrainTotals>(ExchangeSums::kTotals);
  deposits_.conductance = fixed_point_for(totals.beta_dt * (kDividedOffsets * kDividedOffsets / 4));
  deposits_.impulse = fixed_point_for(sums.largest_exchange());
}

void Deposit::update_fraction(FluidState& fluid, const ExchangeSums& sums) {
  std::swap(fluid.alpha_f, fluid.alpha_f_previous);
  decode(Deposits::kVolume, deposits_.volume, fields_.deposited, fields_.smoothed, fluid.alpha_f);
  grid_.raise_to_kept(fluid.alpha_f, fields_.smoothed);
  grid_.smoother.solve(fluid.alpha_f, fields_.smoothed);
  sum_each_cell("coupling: solid fraction to fluid fraction", sums, ExchangeSums::kDepositedVolume,
                owned_cells(grid_.grid),
                ByRegion{fields_.smoothed.ref(), SolidToFluidFraction{grid_.grid, fluid.alpha_f},
                         ClearWater{fluid.alpha_f}});
  if (grid_.bodies)
    grid_.bodies->add_solid_inside(fluid.alpha_f, sums, ExchangeSums::kVolumeInBodies);
  grid_.boundary.fill(fluid.alpha_f, FieldKind::scalar);
  if (!config_.alpha_time_derivative) {  // the fraction counts as if it had always been the new one
    Kokkos::deep_copy(fluid.alpha_f_previous.storage, fluid.alpha_f.storage);
  }
}

/// Exchange and conductances; adds up what the fluid loses [N s].
void Deposit::rows_to_faces(const ExchangeSums& sums) {
  ExchangeOnFaces& on_faces = fields_.on_faces;
  sum_vector("coupling: rows to faces", sums, ExchangeSums::kTakenFromFluid,
             fields_.of_flow.exchange,
             RowsToFaces{.grid = grid_.grid,
                         .deposits = deposits_,
                         .given = on_faces.impulse,
                         .conductance_x = on_faces.conductance_x,
                         .conductance_z = on_faces.conductance_z});
}

/// The same of an exchange that goes to cells, and is smoothed with them.
void Deposit::spread_to_faces(const ExchangeSums& sums) {
  const Region& cells = fields_.of_impulse;
  CellVector& impulse = fields_.impulse_in_cells;
  for (const auto& [quantity, field] :
       {std::pair{Deposits::kImpulseX, &impulse.x}, std::pair{Deposits::kImpulseY, &impulse.y},
        std::pair{Deposits::kImpulseZ, &impulse.z}}) {
    decode(quantity, deposits_.impulse, fields_.deposited, cells, *field);
    if (config_.exchange == Exchange::smoothed) grid_.smoother.solve(*field, fields_.smoothed);
  }
  grid_.fill_ghosts(impulse, cells);
  sum_vector("coupling: spread to faces", sums, ExchangeSums::kTakenFromFluid,
             fields_.of_flow.exchange,
             SpreadToFaces{.grid = grid_.grid,
                           .impulse_x = impulse.x,
                           .impulse_y = impulse.y,
                           .impulse_z = impulse.z,
                           .given = fields_.on_faces.impulse});
}

/// One quantity as a density in the cells of a region; zero where the grains gave nothing.
void Deposit::decode(Deposits::Quantity quantity, const FixedPoint& point, const Region& deposited,
                     const Region& cells, Field& density) const {
  DecodeDeposit functor{.grid = grid_.grid,
                        .deposits = deposits_,
                        .point = point,
                        .quantity = quantity,
                        .density = density};
  if (quantity == Deposits::kVolume && config_.void_fraction == VoidFraction::cfdem_faithful) {
    functor.most = kMaxSolid;
  }
  for_each_cell("coupling: decode deposit", cells, ZeroBeyond{deposited.ref(), functor});
}

}  // namespace barchan
