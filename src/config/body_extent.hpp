// The box around a body, as the case gives it.
#pragma once

#include <array>

#include "src/config/config.hpp"

namespace barchan {

/// Smallest box around a body with sides along the axes [m]: from `low` to `high`, x, y, z. A body
/// through the whole domain has that of the domain there.
struct BodyExtent {
  std::array<double, 3> low{}, high{};
};
BodyExtent body_extent(const BodyConfig& body, const std::array<double, 3>& domain);

/// Posts of a fence.
int fence_posts(const BodyConfig& fence);

/// Its height [m].
double body_height(const BodyConfig& body);

/// Its smallest size along the floor [m]: a diameter, a side, a wavelength.
double smallest_width(const BodyConfig& body);

}  // namespace barchan
