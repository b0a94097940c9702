// Deposit of the grains' volume and momentum in the flow.
#pragma once

#include "kernels/coupling/deposit_on_faces.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/coupling/coupling_fields.hpp"
#include "src/coupling/ledger.hpp"
#include "src/parallel/halo.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Points that share out a grain's volume; the largest solid fraction that stays.
struct GrainVolume {
  PointModel points = PointModel::divided;
  Real most = Kokkos::Experimental::infinity_v<Real>;
};

/// Sums over the grains in cells, and the fluid fraction, after the grain steps of a fluid step.
/// Grid and fields outlive it.
class Deposit {
 public:
  Deposit(const CoupledCase& config, const GrainState& grains, const CouplingGrid& grid,
          CouplingFields& fields, Real most_solid);

  /// Adds up what the grains give, and marks their columns of cells, on the device. First of all.
  void add_totals(const ExchangeOfGrain& of_grain, const GrainState& grains,
                  const ExchangeSums& sums) const;
  /// Fetches the totals; then sets the regions of the deposit but those of the exchange.
  void find_cells(const ExchangeSums& sums);
  /// Adds volume and exchange of the grains (CellExchange, LayerExchange) up in cells.
  template <class Exchange>
  void add(const ExchangeOfGrain& of_grain, const Exchange& exchange, int n_grains) {
    fields_.lend_to_deposit();
    clear(fields_.deposited);
    using Launch = DepositGrains<kOnHost ? 256 : 1, Exchange>;
    Kokkos::parallel_for("coupling: deposit", items(Launch::items_for(n_grains)),
                         Launch{of_grain, exchange, deposits_, n_grains});
    halo_.scatter_add(deposits_.sum);
  }
  /// Sets alpha_f; the old one becomes alpha_f_previous. Books the volume.
  void update_fraction(FluidState& fluid, const ExchangeSums& sums) const;
  /// Adds up the solid that belongs to momentum cells, those around `cells`; before the gather.
  void add_solid(const LayerExchange& layers, const GrainState& grains, const Region& cells);
  /// Sets a density to one quantity, in the cells of a region; zero where the grains gave nothing.
  void decode(Deposits::Quantity quantity, const Region& deposited, const Region& cells,
              Field& density) const;

  const Deposits& sums() const { return deposits_; }
  bool keeps_volume() const { return most_solid_ == GrainVolume{}.most; }

 private:
  void fetch_totals(const ExchangeSums& sums);
  void clear(const Region& cells) const;

  const CouplingGrid& grid_;
  CouplingFields& fields_;
  Halo halo_;
  Deposits deposits_;
  Real most_solid_;
  bool alpha_time_derivative_;
};

}  // namespace barchan
