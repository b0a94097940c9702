#include "src/grains/grain_skins.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/grains/grain_skins.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// The largest skin over the largest diameter. With wider ones rebuilds are rarer, but the columns
/// of the search are as much wider, and hold more grains (docs/performance.md).
constexpr Real kLargestSkin = 0.4;

}  // namespace

GrainSkins::GrainSkins(const Config& config, Real r_max)
    : least_(config.grains->skin / 2), largest_(std::max(least_, kLargestSkin * 2 * r_max)) {
  // Three columns must fit into a periodic direction, whatever way it is rounded.
  const auto fit = [&](bool periodic, Real extent) {
    if (periodic) largest_ = std::clamp((1 - 1e-9) * extent / 6 - r_max, least_, largest_);
  };
  fit(config.grains->boundary_x == GrainBoundaryX::periodic, config.size[0]);
  fit(config.grains->boundary_z == GrainBoundaryZ::periodic, config.size[2]);
}

/// The horizon is as long as the fastest grain needs for the largest skin; shorter where so many
/// are fast that skins would on average be more than half as wide again as at rest.
void GrainSkins::set(const GrainState& grains) const {
  SpeedsOfGrains speeds{.grains = grains.kin};
  Real fastest = 0, horizon = 0;
  Kokkos::parallel_reduce("neighbors: fastest grain", items(grains.n), speeds,
                          Kokkos::Max<Real>(fastest));
  fastest = max_over(grains.ranks, fastest);
  if (std::isfinite(fastest)) {                           // otherwise the run is about to end
    speeds.unit = fastest > 0 ? fastest / (1 << 20) : 1;  // room for the sum of a trillion grains
    std::int64_t sum = 0;
    Kokkos::parallel_reduce("neighbors: sum of speeds", items(grains.n), speeds, sum);
    std::vector<std::int64_t> of_all{sum, grains.n};
    sum_over(grains.ranks, of_all);
    const Real mean = speeds.unit * static_cast<Real>(of_all[0]) / static_cast<Real>(of_all[1]);
    if (mean > 0) horizon = std::min((largest_ - least_) / fastest, least_ / 2 / mean);
  }
  Kokkos::parallel_for("neighbors: skins", items(grains.n),
                       SetSkins{.least = least_,
                                .largest = largest_,
                                .horizon = horizon,
                                .grains = grains.kin,
                                .from = grains.x_reference});
}

bool GrainSkins::are_of(const GrainState& grains) const {
  int n_foreign = 0;
  Kokkos::parallel_reduce("neighbors: foreign skins", items(grains.n),
                          CountForeignSkins{least_, largest_, grains.kin}, n_foreign);
  return sum_over(grains.ranks, n_foreign) == 0;
}

}  // namespace barchan
