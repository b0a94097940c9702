#include "src/coupling/clumps_in_flow.hpp"

#include "kernels/coupling/clump_parts.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

GrainState& ClumpsInFlow::parts(GrainState& grains) {
  if (grains.clump.size() == 0) return grains;
  reserve_entries(kin_, grains.n);
  Kokkos::parallel_for("clumps: parts", items(grains.members.n),
                       PartsOfClumps{.clumps = clumps_of(grains),
                                     .grains = grains.kin,
                                     .part_kin = kin_,
                                     .part = grains.fluid.part});
  parts_ = grains;
  parts_.kin = kin_;
  return parts_;
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
