// The grains of all ranks on rank 0, for what looks at all of them at once.
#pragma once

#include <vector>

#include "src/diagnostics/dune_shape.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// Numbers of the rows of all ranks, one rank after the other; on ranks other than 0 nothing. All
/// ranks together.
std::vector<double> on_rank_0(MPI_Comm ranks, const std::vector<double>& mine);

/// The reverse: rank 0 has a number for each row of all ranks, in the same order; each rank gets
/// those of its n rows. All ranks together.
std::vector<int> from_rank_0(MPI_Comm ranks, const std::vector<int>& all, int n);

/// Positions, diameters and velocities along x as the dune analytics take them.
class GatheredGrains {
 public:
  /// All ranks together; empty on ranks other than 0.
  explicit GatheredGrains(const GrainState& grains);
  GrainCloud cloud() const { return {centres_, diameters_, u_x_}; }

 private:
  std::vector<double> centres_, diameters_, u_x_;
};

/// A vector of each grain, in the same order.
std::vector<Vec3> gathered(const GrainState& grains, const Kokkos::View<Vec3*>& of_grain);

}  // namespace barchan
