#include "src/case/config.hpp"

#include <cmath>

#include "src/bodies/make_bodies.hpp"
#include "src/case/derived.hpp"
#include "src/fluid/flow_schedule.hpp"
#include "src/fluid/mesh.hpp"

namespace barchan {

namespace {

FluidCase fluid_case(const Config& c, const Bodies& bodies) {
  return {.file = c.file,
          .fluid = c.fluid.value(),
          .solver = c.solver,
          .size = c.size,
          .row_faces = row_faces(row_spacing(*c.fluid, c.size[1])),
          .schedule = flow_schedule(*c.fluid),
          .bodies = bodies,
          .with_grains = c.grains.has_value()};
}

/// Water that a resolved flow with cells so wide is too coarse for: two of them.
Film film_of(const Config& c) {
  if (!c.fluid || c.coupling.scheme != CouplingScheme::resolved) return {};
  const double volume = c.size[0] * c.size[1] * c.size[2];
  const auto& [nx, ny, nz] = c.fluid->cells;
  return {.viscosity = c.fluid->density * c.fluid->kinematic_viscosity,
          .reach = 2 * std::cbrt(volume / nx / ny / nz)};
}

GrainsCase grains_case(const Config& c, const Bodies& bodies) {
  std::vector<std::string> names;
  for (const BodyConfig& body : c.bodies) names.push_back(body.name);
  return {.grains = c.grains.value(),
          .film = film_of(c),
          .size = c.size,
          .half_edge_strip = half_edge_strip(c),
          .fluid_step = c.time.fluid_step,
          .keeps_forces = c.output.grain_forces,
          .bodies = bodies,
          .body_names = names};
}

}  // namespace

Config::operator FluidCase() const { return fluid_case(*this, make_bodies(bodies, size)); }

Config::operator GrainsCase() const { return grains_case(*this, make_bodies(bodies, size)); }

Config::operator CoupledCase() const {
  const Bodies all = make_bodies(bodies, size);
  CoupledCase both{.coupling = coupling, .time = time, .fluid = {}, .grains = {}};
  if (fluid) both.fluid = fluid_case(*this, all);
  if (grains) both.grains = grains_case(*this, all);
  return both;
}

}  // namespace barchan
