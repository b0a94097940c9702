#include "src/config/realisation.hpp"

#include <cmath>

#include "src/config/derived.hpp"
#include "src/config/load.hpp"

namespace barchan {

namespace {

bool is_random(const std::filesystem::path& start) {
  return start == "turbulent" || (start.extension() == ".toml" && is_random(load_config(start)));
}

/// Time in which the eddies of a channel change, in whole fluid steps [s].
double turnover(const Config& config) {
  const FluidNumbers flow = *derive(config, {}).fluid;
  const double step = config.time.fluid_step;
  return flow.u_star > 0 ? step * std::ceil(flow.delta / flow.u_star / step) : 0;
}

}  // namespace

bool is_random(const Config& config) {
  return (config.fluid && is_random(config.initial.fluid)) ||
         (config.grains && (config.initial.pour || is_random(config.initial.grains)));
}

Config realisation_of(const Config& config, int realisation) {
  Config other = config;
  if (realisation == 1 || !is_random(config)) return other;
  if (config.fluid && !config.grains && config.initial.fluid == "turbulent") {
    other.time.end += (realisation - 1) * turnover(config);
  } else {
    other.initial.realisation = realisation;
  }
  return other;
}

}  // namespace barchan
