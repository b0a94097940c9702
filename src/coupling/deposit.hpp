// From the grains to the flow.
#pragma once

#include "kernels/coupling/deposit_on_faces.hpp"
#include "src/coupling/coupling_fields.hpp"
#include "src/coupling/ledger.hpp"
#include "src/parallel/halo.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// How the volume of grains becomes a solid fraction.
struct GrainVolume {
  PointModel points = PointModel::divided;
  Real most = Kokkos::Experimental::infinity_v<Real>;  // what is above is dropped
};

/// Sums over the grains in cells, and the fluid fraction, after the grain steps of a fluid step.
/// Grid and fields outlive it.
class Deposit {
 public:
  Deposit(const Config& config, const GrainState& grains, const CouplingGrid& grid,
          CouplingFields& fields, Real most_solid);

  /// First of all: what the grains give, added up on the device, and their columns of cells.
  void add_totals(const ExchangeOfGrain& of_grain, const GrainState& grains,
                  const ExchangeSums& sums) const;
  /// Fetches the totals; then sets the regions of the deposit but those of the exchange.
  void find_cells(const ExchangeSums& sums);
  /// Volume and exchange of the grains in cells: CellExchange or LayerExchange.
  template <class Exchange>
  void add(const ExchangeOfGrain& of_grain, const Exchange& exchange, int n_grains) {
    fields_.lend_to_deposit();
    clear(fields_.deposited);
    using Launch = DepositGrains<kOnHost ? 128 : 1, Exchange>;
    Kokkos::parallel_for("coupling: deposit", items(Launch::items_for(n_grains)),
                         Launch{of_grain, exchange, deposits_, n_grains});
    halo_.scatter_add(deposits_.sum);
  }
  /// alpha_f from the grains' volume; the old one becomes alpha_f_previous. Books the volume.
  void update_fraction(FluidState& fluid, const ExchangeSums& sums) const;
  /// Before the gather: the solid that belongs to momentum cells, around those that hold grains.
  void add_solid(const LayerExchange& layers, const GrainState& grains, const Region& cells);
  /// One quantity as a density in the cells of a region; zero where the grains gave nothing.
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
