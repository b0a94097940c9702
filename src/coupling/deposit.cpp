#include "src/coupling/deposit.hpp"

#include <algorithm>
#include <utility>

#include "kernels/grains/sphere.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "src/parallel/poison.hpp"

namespace barchan {

namespace {

/// Cells around those that grains' volume is spread over: their faces, and the columns that the
/// pressure equation relaxes. These reach four cells beyond what is obstructed by more than 1e-5,
/// which ends where less than half of the twelve digits has decayed (LocalCorrection).
int cells_around(int smoothing_reach, int pressure_reach) {
  return 1 + std::max(0, pressure_reach - smoothing_reach / 2);
}

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

Deposit::Deposit(const CoupledCase& config, const GrainState& grains, const CouplingGrid& grid,
                 CouplingFields& fields, Real most_solid)
    : grid_(grid),
      fields_(fields),
      halo_(grid.grid, Deposits::kQuantities),
      most_solid_(most_solid),
      alpha_time_derivative_(config.coupling.alpha_time_derivative) {
  deposits_.sum = decltype(deposits_.sum)("deposits", CellIndex::count(grid.grid));
  Real largest = static_cast<Real>(grains.n_initial) * sphere_volume(grains.r_max);
  if (grains.clump.size() > 0) largest *= grains.shapes.largest_count();
  if (config.grains->grains.feed)
    largest = std::max(largest, largest_of_cell(grid.grid, grains.r_max));
  deposits_.volume = fixed_point_for(largest);
}

void Deposit::add_totals(const ExchangeOfGrain& of_grain, const GrainState& grains,
                         const ExchangeSums& sums) const {
  grid_.mark_columns_of(grains);
  Kokkos::parallel_reduce("coupling: totals", items(grains.n), AddTotals{of_grain},
                          sums.into<GrainTotals>(ExchangeSums::kTotals));
}

/// Where the grains are, what of their volume the smoothing spreads, and what the flow has to know.
void Deposit::find_cells(const ExchangeSums& sums) {
  fetch_totals(sums);
  const int reach = grid_.smoother.reach();
  const ColumnMap of_grains = grid_.columns_of_grains();
  ColumnMap smoothed = of_grains.dilated(reach);
  smoothed.set_top(grid_.smoother.top_above(of_grains.top()));
  fields_.smoothed.set(smoothed);
  const ColumnMap of_flow = smoothed.united(fields_.of_fraction.cells.columns())
                                .dilated(cells_around(reach, grid_.pressure_reach))
                                .padded_to_blocks()
                                .united(grid_.bodies ? grid_.bodies->columns() : ColumnMap{});
  fields_.of_flow.fraction.set(of_flow);
  fields_.deposited.set(of_grains.dilated(1).padded_to_blocks());
  if (grid_.smoothing_length == 0) return;
  Field& alpha_raw = fields_.alpha_raw;
  const Region& around = fields_.of_flow.fraction.dilated;  // of whose faces both sides are read
  for_each_cell("coupling: raw fraction", around,
                OneBeyond{fields_.of_fraction.dilated.ref(), alpha_raw});
  grid_.boundary.fill_scalars(around, alpha_raw);
}

/// Columns of the grains and bounds of what they give; with these the fixed points, as one cell can
/// receive everything.
void Deposit::fetch_totals(const ExchangeSums& sums) {
  sums.combine_totals(ranks_of(grid_.grid));
  grid_.marks.copy_to_host();
  sums.copy_to_host();
  Kokkos::fence("coupling: columns and totals");
  const auto totals = sums.get<GrainTotals>(ExchangeSums::kTotals);
  deposits_.interlayer_drag =
      fixed_point_for(totals.rows_dt * (kDividedOffsets * kDividedOffsets / 4));
  deposits_.impulse = fixed_point_for(sums.largest_exchange());
}

/// Where the sums are zero that grains are then added to; the ghosts are added to their owners.
void Deposit::clear(const Region& cells) const {
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

void Deposit::update_fraction(FluidState& fluid, const ExchangeSums& sums) const {
  std::swap(fluid.alpha_f, fluid.alpha_f_previous);
  decode(Deposits::kVolume, fields_.deposited, fields_.smoothed, fluid.alpha_f);
  grid_.renormalise(fluid.alpha_f, fields_.smoothed);
  grid_.smoother.solve(fluid.alpha_f, fields_.smoothed);
  sum_each_cell("coupling: solid fraction to fluid fraction", sums, ExchangeSums::kDepositedVolume,
                owned_cells(grid_.grid),
                ByRegion{fields_.smoothed.ref(), SolidToFluidFraction{grid_.grid, fluid.alpha_f},
                         ClearWater{fluid.alpha_f}});
  if (grid_.bodies)
    grid_.bodies->add_solid_inside(fluid.alpha_f, sums, ExchangeSums::kVolumeInBodies);
  grid_.boundary.fill(fluid.alpha_f, FieldKind::scalar);
  if (!alpha_time_derivative_) {  // the fraction counts as if it had always been the new one
    Kokkos::deep_copy(fluid.alpha_f_previous.storage, fluid.alpha_f.storage);
  }
}

void Deposit::add_solid(const LayerExchange& layers, const GrainState& grains,
                        const Region& cells) {
  clear(cells);
  Kokkos::parallel_for("coupling: solid of momentum cells", items(grains.n),
                       DepositSolid{layers, grains.kin, deposits_});
  halo_.scatter_add(deposits_.sum);
}

/// Coefficients of the interlayer drag are decoded where their faces are; their slots hold the
/// solid of momentum cells until then.
void Deposit::decode(Deposits::Quantity quantity, const Region& deposited, const Region& cells,
                     Field& density) const {
  const bool volumes = quantity < Deposits::kImpulseX;
  DecodeDeposit functor{.grid = grid_.grid,
                        .deposits = deposits_,
                        .point = volumes ? deposits_.volume : deposits_.impulse,
                        .quantity = quantity,
                        .density = density};
  if (quantity == Deposits::kVolume) functor.most = most_solid_;
  for_each_cell("coupling: decode deposit", cells, ZeroBeyond{deposited.ref(), functor});
}

}  // namespace barchan
