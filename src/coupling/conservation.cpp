#include "src/coupling/conservation.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

double relative(const Vec3& difference, const Vec3& reference) {
  const double size = norm(reference);
  return size > 0 ? norm(difference) / size : norm(difference);
}

void put(std::map<std::string, double>& entries, const std::string& name, const Vec3& v) {
  entries[name + "_x"] = v.x;
  entries[name + "_y"] = v.y;
  entries[name + "_z"] = v.z;
}

}  // namespace

void Ledger::close_step(const ExchangeLedger& step, const GrainState& grains) {
  std::vector<std::int64_t> counts{grains.n, grains.n_left};
  sum_over(grains.ranks, counts);
  if (counts[0] + counts[1] != grains.n_initial) {
    throw std::runtime_error(
        "grains inside and left do not add up to those at the start: " + std::to_string(counts[0]) +
        " + " + std::to_string(counts[1]) + " is not " + std::to_string(grains.n_initial));
  }
  given_ += step.given_to_grains;
  taken_ += step.taken_from_fluid;
  implicit_ += step.implicit_on_fluid;
  carried_sum_ += step.carried_to_grains;
  if (step.grain_volume > 0) {
    volume_ = std::max(volume_, std::abs(step.deposited_volume / step.grain_volume - 1));
  }
  exchange_ = std::max(
      exchange_, relative(step.taken_from_fluid - step.given_to_grains, step.given_to_grains));
  carried_ = std::max(
      carried_, relative(step.carried_to_grains - step.implicit_on_fluid, step.implicit_on_fluid));
}

std::map<std::string, double> Ledger::entries() const {
  std::map<std::string, double> e;
  put(e, "impulse_given_to_grains", given_);
  put(e, "impulse_taken_from_fluid", taken_);
  put(e, "impulse_implicit_on_fluid", implicit_);
  put(e, "impulse_carried_to_grains", carried_sum_);
  e["largest_volume_mismatch"] = volume_;
  e["largest_exchange_mismatch"] = exchange_;
  e["largest_carried_mismatch"] = carried_;
  return e;
}

}  // namespace barchan
