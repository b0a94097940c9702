// Grains as the fluid step meets them: a fluid fraction and an exchange on faces.
#pragma once

#include "src/fluid/flow_term.hpp"

namespace barchan {

/// Drag between rows, implicit. The impulse of the exchange is part of the predictor.
class GrainsInFlow : public FlowTerm {
 public:
  GrainsInFlow(const Grid& grid, Real density);

  /// Takes the exchange of the next step; null: none.
  void set(const ExchangeOnFaces* exchange) { exchange_ = exchange != nullptr ? exchange : &none_; }
  const ExchangeOnFaces& exchange() const { return *exchange_; }

  /// Regions of the exchange. Without them the fraction may vary everywhere.
  const FlowRegions* regions() const override;
  /// Moves momentum within columns alone, so the flow rate stays.
  void after_predict(const FlowStep& step) override;

 private:
  Grid grid_;
  Real density_;  // of the fluid [kg/m^3]
  FlowRegions anywhere_, fraction_alone_;
  ExchangeOnFaces none_;
  const ExchangeOnFaces* exchange_ = &none_;
};

}  // namespace barchan
