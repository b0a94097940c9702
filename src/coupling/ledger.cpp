#include "src/coupling/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Largest mismatch of a closed exchange, relative to it. Rounding leaves 1e-16 to 1e-12.
constexpr double kClosed = 1e-9;

double relative(const Vec3& difference, const Vec3& reference) {
  const double size = norm(reference);
  return size > 0 ? norm(difference) / size : norm(difference);
}

}  // namespace

void ExchangeSums::combine_totals(MPI_Comm ranks) const {
  combine(ranks, kTotals, kFastest - kTotals, MPI_SUM);
  combine(ranks, kFastest, 1, MPI_MAX);
}

Real ExchangeSums::largest_exchange() const {
  const auto totals = get<GrainTotals>(kTotals);
  const Real fastest = std::max(get(kFastest), Real(0));  // below zero where no cells were
  return totals.size + 4 * fastest * totals.rows_dt;
}

ExchangeLedger ExchangeSums::ledger(MPI_Comm ranks, Real dt) const {
  combine(ranks, kPressureOnSolid, kSums - kPressureOnSolid, MPI_SUM);
  fetch();
  const auto totals = get<GrainTotals>(kTotals);
  return {.grain_volume = totals.volume,
          .deposited_volume = get(kDepositedVolume) - get(kVolumeInBodies),
          .given_to_grains = totals.impulse,
          .taken_from_fluid = get<Vec3>(kTakenFromFluid),
          .largest_exchange = largest_exchange(),
          .flow_on_solid = dt * (get<Vec3>(kPressureOnSolid) + get<Vec3>(kStressOnSolid)),
          .flow_on_grains = dt * get<Vec3>(kForceOnGrains)};
}

void Ledger::close_step(const ExchangeLedger& step, const GrainState& grains) {
  std::vector<std::int64_t> counts{grain_count(grains), grains.n_left};
  sum_over(grains.ranks, counts);
  const std::int64_t came = grains.n_initial + grains.feed.n_fed;
  if (counts[0] + counts[1] != came) {
    throw std::runtime_error(fmt::format(
        "grains inside and left do not add up to those at the start and fed: {} + {} is not {}",
        counts[0], counts[1], came));
  }
  expect_closed(step);
  add(step);
}

/// Checks that an exchange is closed. Values that are not finite are left to the checks of the
/// state, which know where they are.
void Ledger::expect_closed(const ExchangeLedger& step) {
  const auto expect = [](const char* what, double off, double of, const char* unit) {
    if (!(off > kClosed * of)) return;
    throw std::runtime_error(
        fmt::format("{} is off by {:.3g} of {:.3g} {} in this step: nothing of this run can be "
                    "trusted. This is "
                    "a fault of the program; please report it with the case",
                    what, off, of, unit));
  };
  if (step.keeps_volume)
    expect("the volume of the grains in the cells of the flow",
           std::abs(step.deposited_volume - step.grain_volume), step.grain_volume, "m3");
  expect("the momentum that the water gives to the grains",
         norm(step.taken_from_fluid - step.given_to_grains), step.largest_exchange, "N s");
}

void Ledger::add(const ExchangeLedger& step) {
  const auto sum = [this](const std::string& name, const Vec3& v) {
    entries_[name + "_x"] += v.x, entries_[name + "_y"] += v.y, entries_[name + "_z"] += v.z;
  };
  sum("impulse_given_to_grains", step.given_to_grains);
  sum("impulse_taken_from_fluid", step.taken_from_fluid);
  sum("impulse_of_flow_on_solid", step.flow_on_solid);
  sum("impulse_of_flow_on_grains", step.flow_on_grains);
  const auto keep = [this](const char* name, double mismatch) {
    entries_[name] = std::max(entries_[name], mismatch);
  };
  const Real volume = step.grain_volume;
  keep("largest_volume_mismatch", volume > 0 ? std::abs(step.deposited_volume / volume - 1) : 0);
  keep("largest_exchange_mismatch",
       relative(step.taken_from_fluid - step.given_to_grains, step.given_to_grains));
  keep("largest_flow_force_mismatch",
       relative(step.flow_on_grains - step.flow_on_solid, step.flow_on_solid));
}

}  // namespace barchan
