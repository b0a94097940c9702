// How wide the skin of each grain is in the neighbour list.
#pragma once

#include "src/grains/grain_state.hpp"
#include "src/grains/grains_case.hpp"

namespace barchan {

/// Skins follow the speed: a list expires for all grains at about the same time, though a few
/// move a hundred times as fast as the rest.
class GrainSkins {
 public:
  /// `reach`: of the contact law between two surfaces [m].
  GrainSkins(const GrainsCase& config, Real r_max, Real reach = 0);

  /// Of a grain at rest, half of grains.skin; and of any grain [m].
  Real least() const { return least_; }
  Real largest() const { return largest_; }
  /// Columns of the neighbour search: how many rings of them hold the partners of a grain, and how
  /// wide they must be [m].
  int rings() const { return rings_; }
  Real column_width() const { return column_width_; }
  /// Sets those of a new list, from where the grains are now (x_reference). All ranks together.
  void set(const GrainState& grains) const;
  /// False if any is not within these bounds. All ranks together.
  bool suit(const GrainState& grains) const;

 private:
  int rings_ = 2;
  Real least_ = 0, largest_ = 0, column_width_ = 0;
};

}  // namespace barchan
