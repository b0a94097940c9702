// State of a feed of grains from one fluid step to the next (src/grains/grain_feed.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Grain without a place: radius [m], mass [kg], index of its kind. A clump has the radius of the
/// sphere of its volume.
struct GrainBody {
  Real r = 0, m = 0, kind = 0;
  auto operator<=>(const GrainBody&) const = default;
};

/// State of a feed, the same on all ranks.
struct FeedState {
  std::int64_t n_fed = 0;          // grains that have come in
  std::int64_t next_id = 0;        // id of the next grain; 0: none has been given yet
  std::int64_t n_tries = 0;        // places that were tried, for the random numbers
  std::int64_t n_steps = 0;        // fluid steps since t = 0
  Real due = 0;                    // grains that a given rate makes by now,
  std::int64_t n_asked = 0;        // grains asked for so far: they wait or are in
  std::vector<GrainBody> bodies;   // bodies of the grains at the start, in ascending order
  std::vector<GrainBody> waiting;  // grains that have no place yet, in their order
};

}  // namespace barchan
