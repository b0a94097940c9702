// A small coupled case: 200 grains in a turbulent channel of 12 x 6 x 6 mm.
#pragma once

#include "src/config/config.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan::testing {

inline Config coupled_config() {
  Config c;
  c.title = "small coupled case";
  c.size = {0.012, 0.006, 0.006};
  c.time.fluid_step = 2.5e-4;
  c.time.grain_step = 5e-6;
  c.time.end = 40 * 2.5e-4;
  c.fluid.emplace();
  c.fluid->cells = {10, 14, 6};
  c.fluid->first_cell_height = 2.6e-4;
  c.fluid->mean_velocity = 0.2;
  c.grains.emplace();
  c.grains->material.youngs_modulus = 1.25e6;
  c.grains->material.rolling_friction = 0.05;
  c.grains->wall = c.grains->material;
  c.grains->sizes = {{1.5e-4, 20}, {2e-4, 160}, {2.5e-4, 20}};
  c.initial.fluid = "turbulent";
  c.initial.pour.emplace();
  c.initial.pour->centre = {0.008, 0.003};
  c.initial.pour->radius = 0.0018;
  c.output.grains_interval = 0.0025;
  c.output.fields_interval = 0.005;
  c.output.dune_interval = 0.0025;
  c.output.history_interval = 0.0025;
  c.restart.wall_interval = 0;
  return c;
}

}  // namespace barchan::testing
