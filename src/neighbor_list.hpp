// When to rebuild the Verlet list, and how.
#pragma once

#include "kernels/neighbor_search.hpp"
#include "src/config.hpp"
#include "src/grain_state.hpp"

namespace barchan {

/// Half Verlet list with skin: valid until a grain has moved half the skin from where it was at the
/// last rebuild. A rebuild sorts the grains in space, keeps the contact history and, when asked,
/// drops grains beyond the outlet. Throws std::runtime_error naming the grain if a position is not
/// finite or left the domain where it cannot.
class NeighborList {
 public:
  NeighborList(const Config& config, Real r_max);

  /// The list covers motions up to this squared distance [m^2].
  Real limit() const { return skin_ * skin_ / 4; }
  /// Sorts, searches, carries the history over. `drop` removes grains beyond the outlet.
  void rebuild(GrainState& grains, bool drop);
  /// Searches again from x_reference in the present order: the list as the last rebuild left it.
  void restore(GrainState& grains);
  /// Largest distance from contact within which pairs are evaluated in every sub-step [m].
  Real largest_margin() const { return skin_ / 10; }
  std::int64_t rebuilds() const { return rebuilds_; }
  bool with_rolling = false;  // keep a rolling torque per pair
  bool with_force = false;    // keep the force of each pair in the last sub-step
  const PeriodicBox& box() const { return box_; }

  // Parts of a rebuild; public only because nvcc takes no device lambda from a private function.
  void keep_contacts(const GrainState& grains);
  void sort(GrainState& grains, bool drop);
  Windows find_windows(const Kokkos::View<const GrainKinematics*>& kin, int n);
  void search(GrainState& grains, const Kokkos::View<const GrainKinematics*>& kin, bool has_kept);
  void reserve_pairs(PairList& list) const;
  void register_others(const PairList& list, int n);
  void check_positions(const GrainState& grains) const;
  void wrap(GrainState& grains) const;

 private:
  void make_room(int n);

  Columns columns_;
  PeriodicBox box_;
  Real skin_ = 0, r_max_ = 0;
  Real lx_ = 0, ly_ = 0, lz_ = 0;
  bool exit_x_ = false;
  std::int64_t rebuilds_ = 0;
  OccupiedColumns occupied_;
  KeptContacts kept_;
  Kokkos::View<int*> row_;  // old row of each grain; at the end next free place of other slots
  // Room that serves twice: for reordering, then for noted partners; for sort keys, then windows.
  Kokkos::View<Quad*> room_;
  Kokkos::View<std::uint64_t* [2]> key_room_;
};

}  // namespace barchan
