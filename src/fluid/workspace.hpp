// Memory of the fluid step that others use in between.
#pragma once

#include <array>
#include <vector>

#include "src/parallel/grid.hpp"

namespace barchan {

/// Fields that hold nothing between two parts of a step. The fluid step has the face fields from
/// the predictor to the correction, the pressure solver those in cells during a solve; in between
/// the exchange with grains and the neighbour list take them. Whoever takes a field writes it
/// before reading it.
struct Workspace {
  /// Allocates them all; without `with_flux` that one is empty.
  Workspace(const Grid& grid, bool with_flux);

  FaceVector u_star, flux;     // predicted velocity, alpha u [m/s]
  std::array<Field, 3> cells;  // left with finite values: the solver multiplies some with zero

  /// Fields that may be left with any bits.
  std::vector<Field> of_any_bits() const {
    return {flux.x, flux.y, flux.z, u_star.x, u_star.y, u_star.z};
  }
};

}  // namespace barchan
