#include "src/bodies/make_bodies.hpp"

#include <cmath>

namespace barchan {

Bodies make_bodies(const Config& config) {
  Bodies bodies;
  for (const BodyConfig& body : config.bodies) {
    BodyShapes::with(body.shape, [&]<class Shape>() {
      bodies.body[bodies.n++] = {.shape = OneOf<BodyShapes>(Shape::from(body)),
                                 .foot = {body.centre[0], body.base, body.centre[1]},
                                 .cosine = std::cos(body.angle),
                                 .sine = std::sin(body.angle),
                                 .lx = config.size[0],
                                 .lz = config.size[2]};
    });
  }
  return bodies;
}

}  // namespace barchan
