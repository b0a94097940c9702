#include "src/coupling/exchange_scheme.hpp"

#include <stdexcept>

#include "src/coupling/centred_exchange.hpp"
#include "src/coupling/cfdem_exchange.hpp"
#include "src/coupling/immersed_flow.hpp"
#include "src/coupling/layered_exchange.hpp"
#include "src/coupling/resolved_flow.hpp"

namespace barchan {

std::unique_ptr<ExchangeScheme> make_exchange_scheme(const CoupledCase& config, FluidSolver& solver,
                                                     const GrainState& grains, const Grid& grid) {
  const CouplingConfig& c = config.coupling;
  const FlowAndGrains of{config, solver, grains, grid};
  switch (c.scheme) {
    case CouplingScheme::layered:
      return std::make_unique<LayeredExchange>(of);
    case CouplingScheme::centred:
      return std::make_unique<CentredExchange>(of, c.centred.void_fraction, false);
    case CouplingScheme::smoothed:
      return std::make_unique<CentredExchange>(of, c.smoothed.void_fraction, true);
    case CouplingScheme::cfdem:
      return std::make_unique<CfdemExchange>(of, c.cfdem.smooth_exchange);
    case CouplingScheme::resolved:
      if (is_immersed(c, config.grains->grains))
        return std::make_unique<ImmersedFlow>(config, solver, grains, grid);
      return std::make_unique<ResolvedFlow>(config, solver, grid);
  }
  throw std::logic_error("a scheme without a class");
}

}  // namespace barchan
