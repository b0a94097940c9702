#include "src/grains/grains_case.hpp"

namespace barchan {

bool grains_leave(const GrainConfig& grains) {
  return grains.boundary_x == GrainBoundaryX::exit || grains.boundary_x == GrainBoundaryX::follow;
}

bool is_periodic_x(const GrainConfig& grains) {
  return grains.boundary_x == GrainBoundaryX::periodic ||
         grains.boundary_x == GrainBoundaryX::follow;
}

}  // namespace barchan
