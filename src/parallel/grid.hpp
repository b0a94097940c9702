// Grid: the part that this rank owns.
#pragma once

#include "kernels/fluid/grid.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

class Decomposition;

/// Grid with the heights on the host.
using HostGrid = BasicGrid<Kokkos::View<Real*, Kokkos::HostSpace>>;

/// Grid with its memory.
struct Grid : BasicGrid<Kokkos::View<Real*>> {
  const Decomposition* ranks = nullptr;  // outlives the grid; nullptr: one rank owns everything

  /// Sum of the heights of all x-z columns [m].
  Real height_of_all_columns() const { return ly * nx_all * nz_all; }
  HostGrid on_host() const {
    return {*this, host_copy(y_face_), host_copy(y_centre_), host_copy(row_at_)};
  }
  // NOLINTNEXTLINE(google-explicit-constructor): a Grid is one
  KOKKOS_FORCEINLINE_FUNCTION operator GridRef() const {
    return {static_cast<const GridExtents&>(*this), y_face_.data(), y_centre_.data(),
            row_at_.data()};
  }
};

}  // namespace barchan
