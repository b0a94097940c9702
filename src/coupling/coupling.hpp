// Fluid and grains exchange volume and momentum once per fluid step.
#pragma once

#include "src/coupling/deposit.hpp"
#include "src/coupling/gather.hpp"

namespace barchan {

/// Unresolved coupling, model A: gather before the grain steps, deposit after them. Where the grid
/// is cut, `grains` are those whose centres lie in this rank's pencil (FluidSideGrains), and all
/// ranks call every member together.
class Coupling {
 public:
  Coupling(const Config& config, const FluidSolver& solver, const GrainState& grains,
           const Grid& grid);
  Coupling(const Coupling&) = delete;

  /// alpha_f and alpha_f_previous of grains that have just been placed.
  void start(const GrainState& grains, FluidState& fluid);
  void gather(const FluidState& fluid, GrainState& grains, Real dt);
  void deposit(const GrainState& grains, FluidState& fluid, Real dt);

  const ExchangeOnFaces& on_faces() const { return fields_.on_faces; }
  /// Of the last step.
  const ExchangeLedger& ledger() const { return ledger_; }

 private:
  bool keeps_volume_;
  CouplingGrid grid_;
  CouplingFields fields_;
  Gather gather_;
  Deposit deposit_;
  ExchangeSums sums_;
  ExchangeLedger ledger_;
};

}  // namespace barchan
