// Exchange as in CFDEM, for comparison with it.
#pragma once

#include "src/coupling/centred_exchange.hpp"

namespace barchan {

/// Exchange of the scheme "cfdem": volume above a solid fraction of 0.9 is dropped; grains read
/// velocity and fraction from the centres of cells.
class CfdemExchange final : public CentredExchange {
 public:
  CfdemExchange(const FlowAndGrains& of, bool smooths)
      : CentredExchange(of, {.points = PointModel::cfdem, .most = kMaxSolid}, smooths) {}

 private:
  void flow_at_grains(const FluidState& fluid, const GrainState& grains) override;
};

}  // namespace barchan
