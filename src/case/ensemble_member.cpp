#include "src/case/ensemble_member.hpp"

#include <cmath>

namespace barchan {

namespace {

/// Time in which the eddies of a channel change, in whole fluid steps [s].
double turnover(const SettledCase& the_case) {
  const FluidNumbers& flow = the_case.numbers.fluid.value();
  const double step = the_case.config.time.fluid_step;
  return flow.u_star > 0 ? step * std::ceil(flow.delta / flow.u_star / step) : 0;
}

}  // namespace

Case ensemble_member(const Case& the_case, int realisation) {
  Case other = the_case;
  if (realisation == 1) return other;
  Config& config = other.config;
  if (config.fluid && !config.grains && config.initial.starts_as<TurbulentFlow>()) {
    config.time.end += (realisation - 1) * turnover(the_case);
  } else if (other.random) {
    config.initial.realisation = realisation;
  }
  other.settle();
  return other;
}

}  // namespace barchan
