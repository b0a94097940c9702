#include "src/bodies/make_bodies.hpp"

#include <array>
#include <cmath>

#include "src/config/body_checks.hpp"
#include "src/config/body_extent.hpp"

namespace barchan {
namespace {

static_assert(kMostBodiesOfCase == kMostBodies);

BodyForm form_of(const BodyConfig& body) {
  switch (body.shape) {
    case BodyShape::cylinder:
      break;
    case BodyShape::sphere:
      return BodyForm::sphere;
    case BodyShape::half_sphere:
      return BodyForm::half_sphere;
    case BodyShape::box:
      return BodyForm::box;
    case BodyShape::fence:
      return BodyForm::fence;
    case BodyShape::dune:
      return BodyForm::dune;
    case BodyShape::wave:
      return BodyForm::wave;
  }
  if (body.axis == BodyAxis::x) return BodyForm::cylinder_x;
  return body.axis == BodyAxis::z ? BodyForm::cylinder_z : BodyForm::cylinder;
}

Body make_body(const BodyConfig& body, const std::array<double, 3>& domain) {
  Body b{.form = form_of(body),
         .foot = {body.centre[0], body.base, body.centre[1]},
         .cosine = std::cos(body.angle),
         .sine = std::sin(body.angle),
         .lx = domain[0],
         .lz = domain[2],
         .radius = body.radius,
         .height = body.height,
         .half_size = {body.size[0] / 2, body.size[1] / 2},
         .stoss = body.size[0] - body.lee,
         .lee = body.lee,
         .spacing = body.spacing};
  if (body.shape == BodyShape::cylinder) b.half_size = {body.length / 2, body.length / 2};
  if (body.shape == BodyShape::fence) b.posts = fence_posts(body);
  if (body.shape == BodyShape::wave) b.spacing = body.wavelength;
  return b;
}

}  // namespace

Bodies make_bodies(const Config& config) {
  Bodies bodies;
  for (const BodyConfig& body : config.bodies)
    bodies.body[bodies.n++] = make_body(body, config.size);
  return bodies;
}

}  // namespace barchan
