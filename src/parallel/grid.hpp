// The part of the grid that this rank owns.
#pragma once

#include "kernels/fluid/grid.hpp"

namespace barchan {

class Decomposition;

/// The grid with the heights on the host.
using HostGrid = BasicGrid<Kokkos::View<Real*, Kokkos::HostSpace>>;

/// The grid with its memory.
struct Grid : BasicGrid<Kokkos::View<Real*>> {
  const Decomposition* ranks = nullptr;  // outlives the grid; none: one rank owns everything

  /// All x-z columns times the height of the domain [m].
  Real height_of_all_columns() const { return ly * nx_all * nz_all; }
  HostGrid on_host() const {
    const Kokkos::HostSpace host;
    return {*this, Kokkos::create_mirror_view_and_copy(host, y_face_),
            Kokkos::create_mirror_view_and_copy(host, y_centre_),
            Kokkos::create_mirror_view_and_copy(host, row_at_)};
  }
  // NOLINTNEXTLINE(google-explicit-constructor): a Grid is one
  KOKKOS_FORCEINLINE_FUNCTION operator GridRef() const {
    return {static_cast<const GridExtents&>(*this), y_face_.data(), y_centre_.data(),
            row_at_.data()};
  }
};

}  // namespace barchan
