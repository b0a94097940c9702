// Inertia that a clump has against forces on its spheres.
#pragma once

#include <vector>

#include "kernels/grains/step_limit.hpp"
#include "src/grains/clump_shape.hpp"

namespace barchan {

/// Inertia of a clump in the contacts of each of its spheres, the least over directions and over
/// points of the sphere. A force at r from the centre moves that point by its compliance
/// 1/m + [r]^T I^-1 [r], where [r] f = r x f (docs/theory-grains.md).
std::vector<InertiaInContacts> inertia_in_contacts(const ClumpShape& shape);

}  // namespace barchan
