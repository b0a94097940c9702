// The ledger of mass and momentum over a run.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "src/coupling/coupling.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

double relative(const Vec3& difference, const Vec3& reference) {
  const double size = norm(reference);
  return size > 0 ? norm(difference) / size : norm(difference);
}

}  // namespace

void Ledger::close_step(const ExchangeLedger& step, const GrainState& grains) {
  std::vector<std::int64_t> counts{grains.n, grains.n_left};
  sum_over(grains.ranks, counts);
  if (counts[0] + counts[1] != grains.n_initial) {
    throw std::runtime_error(
        fmt::format("grains inside and left do not add up to those at the start: {} + {} is not {}",
                    counts[0], counts[1], grains.n_initial));
  }
  sum_.given_to_grains += step.given_to_grains;
  sum_.taken_from_fluid += step.taken_from_fluid;
  sum_.implicit_on_fluid += step.implicit_on_fluid;
  sum_.carried_to_grains += step.carried_to_grains;
  if (step.grain_volume > 0) {
    volume_ = std::max(volume_, std::abs(step.deposited_volume / step.grain_volume - 1));
  }
  exchange_ = std::max(
      exchange_, relative(step.taken_from_fluid - step.given_to_grains, step.given_to_grains));
  carried_ = std::max(
      carried_, relative(step.carried_to_grains - step.implicit_on_fluid, step.implicit_on_fluid));
}

std::map<std::string, double> Ledger::entries() const {
  std::map<std::string, double> e{{"largest_volume_mismatch", volume_},
                                  {"largest_exchange_mismatch", exchange_},
                                  {"largest_carried_mismatch", carried_}};
  const auto add = [&e](const std::string& name, const Vec3& v) {
    e[name + "_x"] = v.x, e[name + "_y"] = v.y, e[name + "_z"] = v.z;
  };
  add("impulse_given_to_grains", sum_.given_to_grains);
  add("impulse_taken_from_fluid", sum_.taken_from_fluid);
  add("impulse_implicit_on_fluid", sum_.implicit_on_fluid);
  add("impulse_carried_to_grains", sum_.carried_to_grains);
  return e;
}

}  // namespace barchan
