// Copies of the grains of other ranks beside this one's columns.
#pragma once

#include "kernels/grains/grain_owners.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/particle_exchange.hpp"

namespace barchan {

/// Ghosts stand in the rows after the owned grains, in the order of their columns and heights;
/// which ones there are changes with the neighbour list, where they are in every sub-step.
class GhostGrains {
 public:
  /// Copies every grain beside another rank's columns to that rank; `kin` and grains.id are given
  /// room for the ghosts, which follow the grains.n owned ones. All ranks together.
  void find(GrainState& grains, Kokkos::View<GrainKinematics*>& kin, const SearchColumns& columns,
            const GrainOwners& owners, MPI_Comm ranks);
  /// Position, velocity and spin of the ghosts as their owners have them now. All ranks together.
  void update(const Kokkos::View<GrainKinematics*>& kin);

  int count() const { return counts_.n_from(); }
  const RecordCounts& counts() const { return counts_; }

  // Public only because nvcc takes no device lambda from a private function.
  void choose(const GrainState& grains, const Kokkos::View<GrainKinematics*>& kin,
              const SearchColumns& columns, const GrainOwners& owners, MPI_Comm ranks);
  void place(GrainState& grains, Kokkos::View<GrainKinematics*>& kin, const SearchColumns& columns);

 private:
  RecordCounts counts_;
  Kokkos::View<int*> sent_row_;  // of each record that is sent
  Kokkos::View<int*> row_;       // of each record that is received
  MessageBuffer send_{"ghosts: send", 0}, receive_{"ghosts: receive", 0};
};

}  // namespace barchan
