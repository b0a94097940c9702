// Load of the flow or the grains on a body.
#pragma once

#include "kernels/math/vec3.hpp"

namespace barchan {

/// Force [N] on a body, and torque about the middle of its underside, Body::foot [N m], as a mean
/// over a fluid step.
struct BodyLoad {
  Vec3 force, torque;
};

}  // namespace barchan
