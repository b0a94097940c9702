// Outputs of each cell in fields.h5 and slices, from src/fluid/fluid_fields.hpp.
#pragma once

#include <vector>

#include "src/fluid/fluid_fields.hpp"
#include "src/results/outputs.hpp"

namespace barchan {

/// The arrays of a field in cell centres: one, or one for each component of a vector. The velocity
/// is u, v and w; of others the components are name_x, name_y and name_z.
std::vector<Output> outputs_of(const Field& field, const FluidField& about);
std::vector<Output> outputs_of(const FaceVector& field, const FluidField& about);

/// All arrays of a frame of the flow.
std::vector<Output> flow_outputs();

}  // namespace barchan
