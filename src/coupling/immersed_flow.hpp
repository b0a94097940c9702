// Flow resolved around grains that move.
#pragma once

#include <memory>

#include "src/coupling/exchange_scheme.hpp"
#include "src/coupling/immersed_boundary.hpp"

namespace barchan {

/// Scheme "resolved" where grains move: they are immersed in the flow, which has no fraction and no
/// drag law. Over the grain steps of a fluid step a grain feels the force and torque of the fluid
/// step before. Where the grid is cut it has the grains of this rank, wherever they are.
class ImmersedFlow : public ExchangeScheme {
 public:
  ImmersedFlow(const CoupledCase& config, FluidSolver& solver, const GrainState& grains,
               const Grid& grid);

  void start(const GrainState& grains, FluidState& fluid) override;
  void gather(const FluidState& fluid, GrainState& grains, Real dt) override;
  /// Places the grains where the flow will meet them.
  void deposit(const GrainState& grains, FluidState& fluid, Real dt) override;
  void close(GrainState& grains, Real dt) override;

  const ExchangeOnFaces* on_faces() const override { return nullptr; }
  const ExchangeLedger& ledger() const override { return ledger_; }

 private:
  std::shared_ptr<ImmersedBoundary> boundary_;
  SubmergedWeight weight_;
  ExchangeLedger ledger_;
};

}  // namespace barchan
