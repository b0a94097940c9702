// A force on every grain with its name, as results files show it.
#pragma once

#include <string>

#include "kernels/math/vec3.hpp"

namespace barchan {

/// One force on every grain, in the order of the grains [N].
struct NamedForce {
  std::string name;  // "force_drag", "force_contact_normal", ...
  Kokkos::View<const Vec3*> values;
};

}  // namespace barchan
