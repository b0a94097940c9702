// How wide the skin of each grain is in the neighbour list.
#pragma once

#include "src/config/config.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// Skins follow the speed: a list wears out for all grains at about the same time, though a few
/// move a hundred times as fast as the rest.
class GrainSkins {
 public:
  GrainSkins(const Config& config, Real r_max);

  /// Of a grain at rest, half of grains.skin; and of any grain [m].
  Real least() const { return least_; }
  Real largest() const { return largest_; }
  /// Sets those of a new list, from where the grains are now (x_reference). All ranks together.
  void set(const GrainState& grains) const;
  /// False if any is not within these bounds. All ranks together.
  bool are_of(const GrainState& grains) const;

 private:
  Real least_ = 0, largest_ = 0;
};

}  // namespace barchan
