// The faces and cells of the flow's grid that bodies close.
#pragma once

#include <vector>

#include "kernels/fluid/body_faces.hpp"
#include "src/fluid/solids.hpp"
#include "src/parallel/halo.hpp"

namespace barchan {

/// Faces and cells of this rank; faces in the order of their solids.
struct BodyFaces {
  std::vector<BodyFace> faces;
  std::vector<BodyCell> cells;
};

/// A face is closed if its middle lies in a solid or on its surface, or if one of its cells cannot
/// be reached by the fluid. Walls of the domain are left out. nu in m^2/s. All ranks together.
BodyFaces find_body_faces(const Solids& solids, const Grid& grid, const Halo& halo, Real nu);

}  // namespace barchan
