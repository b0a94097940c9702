#include "src/config/body_extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace barchan {
namespace {

struct HalfSizes {
  double x = 0, z = 0;  // [m]; 0: through the whole domain
};

HalfSizes half_sizes(const BodyConfig& b) {
  const double c = std::abs(std::cos(b.angle)), s = std::abs(std::sin(b.angle));
  const double r = b.radius, half = b.length / 2;
  switch (b.shape) {
    case BodyShape::sphere:
    case BodyShape::half_sphere:
      return {r, r};
    case BodyShape::cylinder:
      if (b.axis == BodyAxis::x) return {half, r};
      if (b.axis == BodyAxis::z) return {r, half};
      return {r, r};
    case BodyShape::fence:
      return {s * half + r, c * half + r};
    case BodyShape::box: {
      const auto [x, z] = b.size;
      return {x > 0 ? (c * x + s * z) / 2 : 0, z > 0 ? (s * x + c * z) / 2 : 0};
    }
    case BodyShape::dune:
      return {b.size[0] / 2, b.size[1] / 2};
    case BodyShape::wave:
      break;
  }
  return {};
}

}  // namespace

double body_height(const BodyConfig& b) {
  if (b.shape == BodyShape::half_sphere) return b.radius;
  const bool lies = b.shape == BodyShape::cylinder && b.axis != BodyAxis::y;
  return lies || b.shape == BodyShape::sphere ? 2 * b.radius : b.height;
}

BodyExtent body_extent(const BodyConfig& b, const std::array<double, 3>& domain) {
  const HalfSizes half = half_sizes(b);
  // A dune's centre is that of its crest.
  const double x = b.shape == BodyShape::dune ? b.centre[0] + b.lee - half.x : b.centre[0];
  const double z = b.centre[1];
  BodyExtent extent{{x - half.x, b.base, z - half.z},
                    {x + half.x, b.base + body_height(b), z + half.z}};
  if (half.x == 0) extent.low[0] = 0, extent.high[0] = domain[0];
  if (half.z == 0) extent.low[2] = 0, extent.high[2] = domain[2];
  return extent;
}

int fence_posts(const BodyConfig& fence) {
  return 1 + static_cast<int>(std::floor(fence.length / fence.spacing * (1 + 1e-9)));
}

double smallest_width(const BodyConfig& b) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const double size : {2 * b.radius, b.size[0], b.size[1], b.wavelength})
    if (size > 0) smallest = std::min(smallest, size);
  return smallest;
}

}  // namespace barchan
