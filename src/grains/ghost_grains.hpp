// Ghosts: copies of the grains of other ranks beside this one's columns.
#pragma once

#include "kernels/grains/search_columns.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/pack.hpp"

namespace barchan {

/// Ghosts of a rank, in the entries after the owned grains, in the order of their columns and
/// heights. The choice of ghosts changes with the neighbour list, their positions in every grain
/// step.
class GhostGrains {
 public:
  /// Copies every grain beside another rank's columns to that rank; the arrays that ghosts have are
  /// given room for them behind the grains.n owned entries. All ranks call it together.
  void find(GrainState& grains, const SearchColumns& columns, const GrainOwners& owners);
  /// Updates position, velocity and spin of the ghosts from their owners. All ranks call it
  /// together.
  void update(const Kokkos::View<GrainKinematics*>& kin);

  int count() const { return counts_.n_from(); }
  const ExchangeCounts& counts() const { return counts_; }

  // Parts of find(); public only because nvcc takes no device lambda from a private function.
  void choose(const GrainState& grains, const SearchColumns& columns, const GrainOwners& owners);
  void unpack(GrainState& grains, const SearchColumns& columns);

 private:
  ExchangeCounts counts_;
  Kokkos::View<int*> sent_entry_;  // in the order of the ranks they are sent to
  Kokkos::View<int*> entry_;       // entry of each ghost, in the order they are received
  EntryExchange exchange_{"ghosts"};
};

}  // namespace barchan
