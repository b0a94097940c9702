#include "src/coupling/clumps_in_flow.hpp"

#include <algorithm>
#include <utility>

#include "kernels/coupling/clump_parts.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

ClumpsInFlow::Parts::Parts(GrainState& grains, Kokkos::View<GrainKinematics*>& kin)
    : grains_(grains), kin_(kin) {
  if (grains.clump.size() == 0) return;
  reserve_entries(kin, std::max(grains.n, 1));  // ranks agree on what they send
  Kokkos::parallel_for("clumps: parts", items(grains.members.n),
                       PartsOfClumps{.clumps = clumps_of(grains),
                                     .grains = grains.kin,
                                     .part_kin = kin,
                                     .part = grains.fluid.part});
  std::swap(grains.kin, kin);
}

ClumpsInFlow::Parts::~Parts() {
  if (grains_.clump.size() > 0) std::swap(grains_.kin, kin_);
}

void ClumpsInFlow::join(const GrainState& grains) {
  if (grains.clump.size() == 0) return;
  Kokkos::parallel_for("clumps: join parts", items(grains.members.n),
                       JoinParts{clumps_of(grains), grains.fluid});
}

void ClumpsInFlow::split(const GrainState& grains) {
  if (grains.clump.size() == 0) return;
  Kokkos::parallel_for("clumps: split over parts", items(grains.members.n),
                       SplitOverParts{clumps_of(grains), grains.fluid});
}

}  // namespace barchan
