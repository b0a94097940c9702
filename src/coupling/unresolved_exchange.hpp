// Unresolved coupling, model A: the common part of its schemes.
#pragma once

#include "src/coupling/deposit.hpp"
#include "src/coupling/exchange_scheme.hpp"
#include "src/coupling/gather.hpp"

namespace barchan {

/// Parts that a scheme joins; all but the configuration outlive it.
struct FlowAndGrains {
  const CoupledCase& config;
  const FluidSolver& solver;
  const GrainState& grains;
  const Grid& grid;
};

/// Exchange with grains smaller than the cells, or as large: a volume fraction and a drag law stand
/// for the flow around each. A scheme says in gather() and deposit() where grains feel the flow and
/// where the flow loses what they get; the steps that all schemes share are here.
class UnresolvedExchange : public ExchangeScheme {
 public:
  UnresolvedExchange(const UnresolvedExchange&) = delete;

  void start(const GrainState& grains, FluidState& fluid) final;
  const ExchangeOnFaces* on_faces() const final { return &fields_.on_faces; }
  const ExchangeLedger& ledger() const final { return ledger_; }

 protected:
  UnresolvedExchange(const FlowAndGrains& of, const GrainVolume& volume, bool layers);

  /// Sets the regions of the gather, and the fluid fraction before its smoothing.
  void begin_gather(const FluidState& fluid, const GrainState& grains);
  /// Adds up what the grains give, on the device; the deposit of the scheme follows.
  ExchangeOfGrain begin_deposit(const GrainState& grains, Real dt);
  void end_deposit(Real dt);

  CouplingGrid grid_;
  CouplingFields fields_;
  Gather gather_;
  Deposit deposit_;
  ExchangeSums sums_;

 private:
  ExchangeLedger ledger_;
};

}  // namespace barchan
