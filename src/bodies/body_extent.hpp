// The box around a body, as the case gives it.
#pragma once

#include <array>

#include "src/bodies/bodies_case.hpp"

namespace barchan {

/// Smallest box around a body with sides along the axes [m]: from `low` to `high`, x, y, z. A body
/// through the whole domain extends as far as the domain.
struct BodyExtent {
  std::array<double, 3> low{}, high{};
};
BodyExtent body_extent(const BodyConfig& body, const std::array<double, 3>& domain);

Footprint footprint(const BodyConfig& body);

}  // namespace barchan
