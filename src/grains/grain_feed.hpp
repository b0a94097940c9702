// Feed of grains: [grains.feed].
#pragma once

#include <vector>

#include "kernels/bodies/body.hpp"
#include "kernels/grains/feed.hpp"
#include "src/grains/neighbor_list.hpp"

namespace barchan {

/// Feed of grains at rest at the end of a fluid step, at a given rate or as many as leave. Each is
/// put at random across the stream where it overlaps no other and no body, or waits for the next
/// step. A clump takes the place of the sphere around it, however it is turned. Nothing depends on
/// the number of ranks. All ranks call it together.
class GrainFeed {
 public:
  /// Makes a feed. The case must have [grains.feed].
  explicit GrainFeed(const GrainsCase& config);

  /// Ends a fluid step: grains leave, then others come in.
  void advance(GrainState& grains, NeighborList& list);

 private:
  void note_leaving(GrainState& grains, const NeighborList& list);
  void ask_for_grains(FeedState& feed) const;
  std::vector<FeedPlace> places_to_try(GrainState& grains, const PeriodicBox& box) const;
  std::vector<std::int64_t> taken(const GrainState& grains, const std::vector<FeedPlace>& places,
                                  const PeriodicBox& box) const;
  void come_in(GrainState& grains, NeighborList& list) const;
  Real radius_around(const GrainBody& body) const;
  std::vector<NewGrain> entries_of(const std::vector<NewGrain>& come, const PeriodicBox& box) const;

  GrainConfig grains_;
  FeedConfig config_;
  std::vector<Real> width_;  // of each kind, as width_of()
  Bodies bodies_;
  Real dt_ = 0;                    // fluid step [s]
  Real lz_ = 0;                    // [m]
  bool walls_z_ = false;           // the grains have walls in z
  bool from_window_edge_ = false;  // x counts from the edge of a window that follows its dune
  Kokkos::View<FeedPlace*> places_;
  Kokkos::View<int*> taken_;
  Kokkos::View<LeavingGrain*> leaving_;
  Kokkos::View<int> n_leaving_;
};

/// Bodies of all grains of all ranks, in ascending order. All ranks call it together.
std::vector<GrainBody> bodies_of(const GrainState& grains);

/// Number of grains that should have come in by now and have no place yet.
std::int64_t n_waiting(const FeedState& feed);

}  // namespace barchan
