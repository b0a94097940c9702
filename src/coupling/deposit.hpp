// From the grains to the flow.
#pragma once

#include "kernels/coupling/deposit.hpp"
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
  void operator()(const GrainState& grains, FluidState& fluid, Real dt, ExchangeLedger& ledger);

  /// Before the gather, in crowded cells: the solid of the momentum cells, with ghosts.
  void solid_of_momentum_cells(const GrainState& grains, const FluidState& fluid);

  /// Of the grains of all ranks at the last deposit.
  const GrainExtent& extent() const { return extent_; }

 private:
  ExchangeByRow exchange_by_row(const FluidState& fluid) const;
  void bound_sums(const ExchangeOfGrain& of_grain, int n, const FluidState& fluid,
                  ExchangeLedger& ledger);
  void update_fraction(FluidState& fluid, ExchangeLedger& ledger);
  void spread_to_faces();
  Vec3 taken_from_fluid() const;
  void decode(Deposits::Quantity quantity, const FixedPoint& point, Field& density) const;
  bool smooths(Deposits::Quantity quantity) const;

  CouplingConfig config_;
  const CouplingGrid& grid_;
  CouplingFields& fields_;
  Halo halo_;
  Deposits deposits_;
  GrainExtent extent_;
};

}  // namespace barchan
