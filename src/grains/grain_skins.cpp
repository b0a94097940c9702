#include "src/grains/grain_skins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/grains/grain_skins.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Ratio of the widest skin that counts as narrow to that at rest. Columns are as wide as the reach
/// of two grains with such skins; faster grains are looked for in the second ring.
constexpr Real kNarrowSkin = 3;
/// Largest skin over the largest diameter where a domain is too narrow for two rings. With wider
/// ones rebuilds are rarer, but columns are as much wider, and hold more grains.
constexpr Real kMaxSkin = 0.4;

}  // namespace

GrainSkins::GrainSkins(const GrainsCase& config, Real r_max, Real reach)
    : least_(config.grains.skin / 2), column_width_(2 * (r_max + kNarrowSkin * least_) + reach) {
  // width of the narrowest periodic direction
  Real narrowest = std::numeric_limits<Real>::infinity();
  if (is_periodic_x(config.grains)) narrowest = config.size[0];
  if (config.grains.boundary_z == GrainBoundaryZ::periodic)
    narrowest = std::min(narrowest, config.size[2]);
  narrowest *= 1 - 1e-9;  // whatever way columns are rounded
  // The walk must not meet a column twice.
  if (narrowest >= 5 * column_width_) {
    largest_ = column_width_ - r_max - reach / 2;
  } else {
    rings_ = 1;
    largest_ = std::max(least_, std::min(kMaxSkin * 2 * r_max, narrowest / 6 - r_max - reach / 2));
    column_width_ = 2 * (r_max + largest_) + reach;
  }
}

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
    if (mean > 0) horizon = skin_horizon(least_, largest_, fastest, mean);
  }
  Kokkos::parallel_for("neighbors: skins", items(grains.n),
                       SetSkins{.least = least_,
                                .largest = largest_,
                                .horizon = horizon,
                                .grains = grains.kin,
                                .from = grains.x_reference});
}

bool GrainSkins::suit(const GrainState& grains) const {
  int n_foreign = 0;
  Kokkos::parallel_reduce("neighbors: foreign skins", items(grains.n),
                          CountSkinsOutOfRange{least_, largest_, grains.kin}, n_foreign);
  return sum_over(grains.ranks, n_foreign) == 0;
}

}  // namespace barchan
