#include "src/fluid/workspace.hpp"

#include <string>

namespace barchan {

namespace {

/// One allocation for all three components, so that ScratchMemory can lend it whole.
FaceVector make_faces_in_one_piece(const std::string& label, const Grid& grid) {
  const Kokkos::View<Real****, Kokkos::LayoutLeft> all(label, grid.nx + 2, grid.ny + 2, grid.nz + 2,
                                                       3);
  const auto component = [&all](int c) {
    return Field(Kokkos::subview(all, Kokkos::ALL, Kokkos::ALL, Kokkos::ALL, c));
  };
  return {component(0), component(1), component(2)};
}

}  // namespace

Workspace::Workspace(const Grid& grid, bool with_flux)
    : u_star(make_faces_in_one_piece("fluid: u star", grid)),
      flux(with_flux ? make_faces_in_one_piece("fluid: alpha u", grid) : FaceVector{}),
      cells{Field("fluid: workspace", grid), Field("fluid: workspace", grid),
            Field("fluid: workspace", grid)} {}

}  // namespace barchan
