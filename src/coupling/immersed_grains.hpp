// Immersed grains that the flow on this rank meets.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/coupling/inner_momentum.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/grid.hpp"

namespace barchan {

/// Grains that reach faces of this rank. Where the grid is cut every rank knows the grains of all,
/// works on those that reach its cells, and adds up with the others what several have a part of:
/// the same bits on all of them. All ranks call every member together.
class ImmersedGrains {
 public:
  /// `patch`: faces that a grain reaches.
  ImmersedGrains(const Grid& grid, const GrainPatch& patch) : grid_(grid), patch_(patch) {}

  /// Takes the grains of all ranks, of which this one has some.
  void place(const GrainState& grains);

  bool are_there() const { return n_all_ > 0; }
  /// Number of grains here; of these the first n_led() are led by this rank: each by one.
  int n() const { return n_; }
  int n_led() const { return n_led_; }
  const Kokkos::View<const GrainKinematics*>& kin() const { return kin_; }

  /// Adds up over ranks the parts that they have read at the markers of grains here.
  void combine_read(const Kokkos::View<Vec3*>& read, int n_markers);
  /// Adds up over ranks the sums of grains here, of what markers gave those of the leader. Returns
  /// the sums of the grains that were placed by this rank, in their order.
  Kokkos::View<const WaterOfGrain*> of_own(const Kokkos::View<WaterOfGrain*>& water);

 private:
  void fetch_all(const GrainState& grains);
  void list_here();

  Grid grid_;
  GrainPatch patch_;
  int n_ = 0, n_led_ = 0, n_all_ = 0, n_shared_ = 0;
  int first_own_ = 0, n_own_ = 0;  // grains placed by this rank, among all
  Kokkos::View<const GrainKinematics*> kin_;

  // Where the grid is cut.
  std::vector<std::int64_t> counts_;     // of grains by rank
  std::vector<Real> numbers_;            // of the grains of all ranks
  Kokkos::View<GrainKinematics*> here_;  // in memory of their own
  Kokkos::View<int*> index_, shared_;    // of a grain here among all, and those of several ranks
  Kokkos::View<Vec3*> read_;             // at the markers of those
  Kokkos::View<WaterOfGrain*> water_;    // of all grains
};

}  // namespace barchan
