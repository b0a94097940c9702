// Grains where the flow around them is: copies on the ranks that own the cells.
#pragma once

#include "kernels/coupling/pencil_owners.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/particle_exchange.hpp"

namespace barchan {

/// Grains live on ranks of their own, chosen for equal contact work. Once in a while copies of them
/// visit the pencils of the flow, and what happens to them there is sent home. Where one rank has
/// everything they are at home already, and nothing is copied.
class FluidSideGrains {
 public:
  FluidSideGrains() = default;
  /// `periodic_x`: grains beyond one end come in at the other.
  FluidSideGrains(const Grid& grid, bool periodic_x);

  /// The grains whose centres lie in this rank's pencil; of their arrays those that `needs` names
  /// are filled. Positions are inside the domain. Valid until the next call. All ranks together.
  template <class Needs>
  GrainState& to_fluid_ranks(GrainState& home, const Needs& needs) {
    if (!is_cut_) return home;
    find_owners(home);
    send(record_layout(home, needs), counts_, row_);
    visitors_.n = counts_.n_from();
    reserve_rows(visitors_, visitors_.n);
    take(record_layout(visitors_, needs), counts_, {});
    wrap_visitors();
    return visitors_;
  }

  /// Brings what `gives` names back to the grains that were brought last; no grain may have moved
  /// to another row since. All ranks together.
  template <class Gives>
  void to_grain_ranks(GrainState& home, const Gives& gives) {
    if (!is_cut_) return;
    send(record_layout(visitors_, gives), counts_.back(), {});
    take(record_layout(home, gives), counts_.back(), row_);
  }
  /// The same for one vector of each visitor.
  void to_grain_ranks(const Kokkos::View<Vec3*>& of_visitors, const Kokkos::View<Vec3*>& home);

  bool is_cut() const { return is_cut_; }

  // Public only because nvcc takes no device lambda from a private function.
  void find_owners(const GrainState& home);
  void wrap_visitors() const;

 private:
  /// Sends the records of rows, and takes those received to rows; without a list in their order.
  void send(const RecordLayout& layout, const RecordCounts& counts,
            const Kokkos::View<const int*>& row);
  void take(const RecordLayout& layout, const RecordCounts& counts,
            const Kokkos::View<const int*>& row) const;

  bool is_cut_ = false;
  MPI_Comm ranks_ = MPI_COMM_SELF;
  PencilOwners owners_;
  GrainState visitors_;
  RecordCounts counts_;
  Kokkos::View<int*> owner_, row_;  // of each grain at home; rows in the order of the owners
  Kokkos::View<int*> count_;        // grains of each owner
  MessageBuffer send_{"fluid-side grains: send", 0}, receive_{"fluid-side grains: receive", 0};
};

}  // namespace barchan
