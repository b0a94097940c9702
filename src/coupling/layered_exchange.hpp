// Layered exchange: each part of a grain exchanges momentum with its own row of cells.
#pragma once

#include "src/coupling/unresolved_exchange.hpp"

namespace barchan {

/// Layered exchange. The forces of pressure gradient and stress reach the grains by the adjoint of
/// the way in which their volume reaches alpha_f, so grains get what the solid fraction takes.
/// Source and reason: docs/theory-coupling.md, "Layered exchange".
class LayeredExchange final : public UnresolvedExchange {
 public:
  explicit LayeredExchange(const FlowAndGrains& of);

  void gather(const FluidState& fluid, GrainState& grains, Real dt) override;
  void deposit(const GrainState& grains, FluidState& fluid, Real dt) override;

 private:
  LayerExchange layers(const FluidState& fluid) const;
  void solid_of_momentum_cells(const FluidState& fluid, const GrainState& grains);
  void pressure_gradient(const FluidState& fluid);
  void smoothed_pressure_gradient(const FluidState& fluid);
  void stress(const FluidState& fluid);
  void flow_at_grains(const FluidState& fluid, const GrainState& grains);
  void to_faces();

  bool oversubscribed_;  // cells so narrow that a momentum cell may get twice the grains that fit
                         // into it
};

}  // namespace barchan
