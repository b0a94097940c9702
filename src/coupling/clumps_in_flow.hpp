// Clumps in a computed flow: from clumps to the parts that the flow meets, and back.
#pragma once

#include "src/grains/grain_state.hpp"

namespace barchan {

/// Grains as the flow meets them. Cases of spheres alone pass through.
class ClumpsInFlow {
 public:
  /// Grains for the gather or the deposit: a sphere of a clump has its share of the clump's volume
  /// and mass. Shares the other arrays of `grains`. Valid until the next call.
  GrainState& parts(GrainState& grains);
  /// After the gather: sums over the parts, with the first sphere of each clump.
  static void join(const GrainState& grains);
  /// Before the deposit: the shares of the parts in what was done to each clump.
  static void split(const GrainState& grains);

 private:
  GrainState parts_;
  Kokkos::View<GrainKinematics*> kin_;
};

}  // namespace barchan
