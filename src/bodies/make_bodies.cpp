#include "src/bodies/make_bodies.hpp"

#include <cmath>

namespace barchan {

Bodies make_bodies(const std::vector<BodyConfig>& bodies, const std::array<double, 3>& domain) {
  Bodies made;
  for (const BodyConfig& body : bodies) {
    BodyShapes::with(body.shape, [&]<class Shape>() {
      made.body[made.n++] = {.shape = OneOf<BodyShapes>(Shape::from(body)),
                             .foot = {body.centre[0], body.base, body.centre[1]},
                             .cosine = std::cos(body.angle),
                             .sine = std::sin(body.angle),
                             .lx = domain[0],
                             .lz = domain[2]};
    });
  }
  return made;
}

}  // namespace barchan
