// Clumps in a computed flow: from clumps to the parts that the flow meets, and back.
#pragma once

#include "src/grains/grain_state.hpp"

namespace barchan {

/// Grains as the flow meets them. Cases of spheres alone pass through.
class ClumpsInFlow {
 public:
  /// While it lives, a sphere of a clump has its share of the clump's volume and mass in
  /// GrainState::kin.
  class Parts {
   public:
    Parts(GrainState& grains, Kokkos::View<GrainKinematics*>& kin);
    ~Parts();
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

   private:
    GrainState& grains_;
    Kokkos::View<GrainKinematics*>& kin_;
  };

  /// Parts for the gather or the deposit.
  [[nodiscard]] Parts parts(GrainState& grains) { return {grains, kin_}; }
  /// After the gather: sums over the parts, with the first sphere of each clump.
  static void join(const GrainState& grains);
  /// Before the deposit: the shares of the parts in what was done to each clump.
  static void split(const GrainState& grains);

 private:
  Kokkos::View<GrainKinematics*> kin_;  // of the parts, or of the grains while there are Parts
};

}  // namespace barchan
