// Grains where the flow around them is: copies on the ranks that own the cells.
#pragma once

#include "kernels/coupling/pencil_owners.hpp"
#include "src/grains/grain_arrays.hpp"

namespace barchan {

/// Copies of the grains on the ranks of the flow. Grains live on ranks of their own, chosen for
/// equal contact work. For gather and deposit copies of them go to the pencils of the flow, and
/// results come back. Where one rank has everything there are no copies: the grains themselves are
/// on the fluid's rank.
class FluidSideGrains {
 public:
  FluidSideGrains() = default;
  /// Makes empty copies of such grains. `periodic_x`: those beyond one end come in at the other.
  /// `forces`: those whose arrays the grains have.
  FluidSideGrains(const Grid& grid, bool periodic_x, const GrainState& grains,
                  const ForceSwitches& forces = {});

  /// Sends copies to the ranks of the flow. Returns the grains whose centres lie in this rank's
  /// pencil, with the arrays of the `uses` (see GrainUse). Positions are inside the domain. Valid
  /// until the next call. All ranks call it together.
  GrainState& to_fluid_ranks(GrainState& grains, unsigned uses);
  const GrainState& to_fluid_ranks(const GrainState& grains, unsigned uses);

  /// Sends the arrays of the `uses` back to the grains that were sent last; no grain may have moved
  /// to another entry since. All ranks call it together.
  void to_grain_ranks(GrainState& grains, unsigned uses);

  // Parts of the sending; public only because nvcc takes no device lambda from a private function.
  void find_owners(const GrainState& grains);
  void wrap_copies() const;

 private:
  void copy_to_fluid_ranks(const GrainState& grains, unsigned uses);

  bool is_cut_ = false;
  MPI_Comm ranks_ = MPI_COMM_SELF;
  PencilOwners owners_;
  GrainState copies_;
  ExchangeCounts counts_;
  Kokkos::View<int*> entry_;  // entries of the grains, in the order of their owners
  EntryExchange exchange_{"fluid-side grains"};
};

}  // namespace barchan
