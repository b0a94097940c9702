#include "src/config/realisation.hpp"

#include <cmath>

#include "src/config/derived.hpp"
#include "src/config/load.hpp"

namespace barchan {

namespace {

/// Time in which the eddies of a channel change, in whole fluid steps [s].
double turnover(const Config& config) {
  const FluidNumbers flow = *derive(config, {}).fluid;
  const double step = config.time.fluid_step;
  return flow.u_star > 0 ? step * std::ceil(flow.delta / flow.u_star / step) : 0;
}

}  // namespace

Config realisation_of(const Config& config, int realisation) {
  Config other = config;
  const InitialConfig& start = config.initial;
  const bool random_grains = config.grains && (start.pour || is_random(start.grains));
  if (realisation == 1) return other;
  if (config.fluid && !config.grains && start.fluid == "turbulent") {
    other.time.end += (realisation - 1) * turnover(config);
  } else if (random_grains || (config.fluid && is_random(start.fluid))) {
    other.initial.realisation = realisation;
  }
  return other;
}

}  // namespace barchan
