// From the grains to the flow.
#pragma once

#include "kernels/coupling/deposit_on_faces.hpp"
#include "src/coupling/coupling_fields.hpp"
#include "src/coupling/ledger.hpp"

namespace barchan {

/// Fluid fraction and exchange of momentum on the faces, after the grain steps of a fluid step.
/// Grid and fields outlive it.
class Deposit {
 public:
  Deposit(const Config& config, const GrainState& grains, const CouplingGrid& grid,
          CouplingFields& fields);

  /// alpha_f from the grains' volume, and their exchange on the faces; the old alpha_f is kept in
  /// alpha_f_previous. Books what the grains give and what arrives.
  void operator()(const GrainState& grains, FluidState& fluid, Real dt, const ExchangeSums& sums);

  /// Before the gather, in crowded cells: the solid of the momentum cells, with ghosts.
  void solid_of_momentum_cells(const GrainState& grains, const FluidState& fluid);

 private:
  ExchangeByRow exchange_by_row(const FluidState& fluid) const;
  void add_totals(const ExchangeOfGrain& of_grain, const GrainState& grains,
                  const FluidState& fluid, const ExchangeSums& sums);
  void find_cells();
  void bound_sums(const ExchangeSums& sums);
  void clear(const Region& cells);
  void update_fraction(FluidState& fluid, const ExchangeSums& sums);
  void rows_to_faces(const ExchangeSums& sums);
  void spread_to_faces(const ExchangeSums& sums);
  void decode(Deposits::Quantity quantity, const FixedPoint& point, const Region& deposited,
              const Region& cells, Field& density) const;

  CouplingConfig config_;
  const CouplingGrid& grid_;
  CouplingFields& fields_;
  Halo halo_;
  Deposits deposits_;
};

}  // namespace barchan
