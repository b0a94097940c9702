// Check that bodies leave the flow a way.
#pragma once

#include "kernels/bodies/body.hpp"
#include "src/fluid/fluid_case.hpp"
#include "src/parallel/grid.hpp"

namespace barchan {

/// True if fluid can go round the periodic domain along x (axis 0) or z (2), through faces that
/// bodies leave open (find_body_faces). `grid`: of all ranks together.
bool passes(const Bodies& bodies, const HostGrid& grid, int axis);

/// Throws InputError if bodies stop a flow that is driven: no force gives it its bulk velocity
/// then. Needs the whole mesh, and no more of it than a straight way takes to be found.
void check_passage(const FluidCase& config);

}  // namespace barchan
