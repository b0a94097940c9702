// Width of each grain's skin in the neighbour list.
#pragma once

#include "src/grains/grain_state.hpp"
#include "src/grains/grains_case.hpp"

namespace barchan {

/// Skins that follow the speed: a list expires for all grains at about the same time, though a few
/// move a hundred times as fast as the rest.
class GrainSkins {
 public:
  /// Sets the bounds. `reach`: of the contact law between two surfaces [m].
  GrainSkins(const GrainsCase& config, Real r_max, Real reach = 0);

  /// Skin of a grain at rest, half of grains.skin; the second, the largest of any grain [m].
  Real least() const { return least_; }
  Real largest() const { return largest_; }
  /// Number of rings of columns that hold the partners of a grain in the neighbour search; the
  /// second, the width that columns must have [m].
  int rings() const { return rings_; }
  Real column_width() const { return column_width_; }
  /// Sets the skins of a new list, from the present positions (x_reference). All ranks call it
  /// together.
  void set(const GrainState& grains) const;
  /// Tells if all skins are within these bounds. All ranks call it together.
  bool suit(const GrainState& grains) const;

 private:
  int rings_ = 2;
  Real least_ = 0, largest_ = 0, column_width_ = 0;
};

}  // namespace barchan
