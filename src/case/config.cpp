#include "src/case/config.hpp"

#include "src/bodies/make_bodies.hpp"
#include "src/case/derived.hpp"
#include "src/fluid/flow_schedule.hpp"
#include "src/fluid/mesh.hpp"

namespace barchan {

FluidCase Config::fluid_case() const {
  return {.file = file,
          .fluid = fluid.value(),
          .solver = solver,
          .size = size,
          .row_faces = barchan::row_faces(row_spacing(*fluid, size[1])),
          .schedule = flow_schedule(*fluid),
          .bodies = make_bodies(bodies, size),
          .with_grains = grains.has_value()};
}

GrainsCase Config::grains_case() const {
  std::vector<std::string> names;
  for (const BodyConfig& body : bodies) names.push_back(body.name);
  return {.grains = grains.value(),
          .size = size,
          .half_seam_strip = barchan::half_seam_strip(*this),
          .fluid_step = time.fluid_step,
          .keeps_forces = output.grain_forces,
          .bodies = make_bodies(bodies, size),
          .body_names = names};
}

CoupledCase Config::coupled_case() const {
  CoupledCase both{.coupling = coupling, .time = time, .fluid = {}, .grains = {}};
  if (fluid) both.fluid = fluid_case();
  if (grains) both.grains = grains_case();
  return both;
}

}  // namespace barchan
