#include "src/bodies/body_extent.hpp"

namespace barchan {

Footprint footprint(const BodyConfig& body) {
  Footprint found;
  BodyShapes::with(body.shape, [&]<class Shape>() { found = Shape::footprint(body); });
  return found;
}

BodyExtent body_extent(const BodyConfig& body, const std::array<double, 3>& domain) {
  const Footprint foot = footprint(body);
  const double x = body.centre[0] + foot.middle_x, z = body.centre[1];
  BodyExtent extent{{x - foot.half_x, body.base, z - foot.half_z},
                    {x + foot.half_x, body.base + foot.height, z + foot.half_z}};
  if (foot.half_x == 0) extent.low[0] = 0, extent.high[0] = domain[0];
  if (foot.half_z == 0) extent.low[2] = 0, extent.high[2] = domain[2];
  return extent;
}

}  // namespace barchan
