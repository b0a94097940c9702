// Grains where the flow around them is: copies on the ranks that own the cells.
#pragma once

#include "kernels/coupling/pencil_owners.hpp"
#include "src/grains/grain_arrays.hpp"

namespace barchan {

/// Grains live on ranks of their own, chosen for equal contact work. For gather and deposit
/// copies of them go to the pencils of the flow, and results come back. Where one rank has
/// everything there are no copies: the grains themselves are on the fluid's rank.
class FluidSideGrains {
 public:
  FluidSideGrains() = default;
  /// `periodic_x`: grains beyond one end come in at the other. `forces`: whose arrays they have.
  FluidSideGrains(const Grid& grid, bool periodic_x, const ForceSwitches& forces = {});

  /// The grains whose centres lie in this rank's pencil; of their arrays those of the `uses` (see
  /// GrainUse) are filled. Positions are inside the domain. Valid until the next call. All ranks
  /// together.
  GrainState& to_fluid_ranks(GrainState& grains, unsigned uses);
  const GrainState& to_fluid_ranks(const GrainState& grains, unsigned uses);

  /// The arrays of the `uses` back to the grains that were sent last; no grain may have moved to
  /// another entry since. All ranks together.
  void to_grain_ranks(GrainState& grains, unsigned uses);

  // Public only because nvcc takes no device lambda from a private function.
  void find_owners(const GrainState& grains);
  void wrap_copies() const;

 private:
  void copy_to_fluid_ranks(const GrainState& grains, unsigned uses);

  bool is_cut_ = false;
  MPI_Comm ranks_ = MPI_COMM_SELF;
  PencilOwners owners_;
  GrainState copies_;
  ExchangeCounts counts_;
  Kokkos::View<int*> entry_;  // of the grains, in the order of their owners
  EntryExchange exchange_{"fluid-side grains"};
};

}  // namespace barchan
