// Bodies of a case, as the kernels know them.
#pragma once

#include <array>
#include <vector>

#include "src/bodies/bodies_case.hpp"

namespace barchan {

/// Makes the bodies in a `domain` of this size [m].
Bodies make_bodies(const std::vector<BodyConfig>& bodies, const std::array<double, 3>& domain);

}  // namespace barchan
