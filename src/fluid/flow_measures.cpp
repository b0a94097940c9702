#include "src/fluid/flow_measures.hpp"

#include <cmath>

#include "kernels/fluid/flow_sums.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

Real bulk_velocity(const FluidState& fluid) {
  const Grid& grid = fluid.grid;
  const Real flow =
      sum_each_cell("fluid: flow rate", grid, FlowRate{grid, fluid.u.x, fluid.alpha_f});
  return flow / sum_each_cell("fluid: volume", grid, HeightSum{grid, fluid.alpha_f});
}

Real bulk_velocity_across(const FluidState& fluid) {
  const Grid& grid = fluid.grid;
  const Real flow = sum_each_cell("fluid: flow rate across", grid,
                                  FlowRateAcross{grid, fluid.u.z, fluid.alpha_f});
  return flow / sum_each_cell("fluid: volume", grid, HeightSum{grid, fluid.alpha_f});
}

Real friction_velocity(const FluidState& fluid, const FluidConfig& config, bool driven_across) {
  const Grid& grid = fluid.grid;
  int walls = 0;
  Real slope = 0;  // sum over the walls of the mean [1/s]
  const auto mean = [&](const Field& u, int row, Real u_wall) {
    const WallShear shear{.grid = grid, .u = u, .row = row, .u_wall = u_wall};
    return sum_each_cell("fluid: wall shear", grid, shear) / (Real(grid.nx_all) * grid.nz_all);
  };
  const auto add = [&](WallFlow wall, int row, Real u_wall) {
    if (wall != WallFlow::no_slip) return;
    const Real along = mean(fluid.u.x, row, u_wall);
    slope += std::hypot(along, driven_across ? mean(fluid.u.z, row, 0) : 0);
    ++walls;
  };
  add(config.bottom, 0, 0);
  add(config.top, grid.ny - 1, config.top_velocity);
  return walls == 0 ? 0 : std::sqrt(config.kinematic_viscosity * slope / walls);
}

Real kinetic_energy(const FluidState& fluid, Real density) {
  const Grid& grid = fluid.grid;
  return density * grid.dx * grid.dz *
         sum_each_cell("fluid: kinetic energy", grid, KineticEnergy{grid, fluid.u, fluid.alpha_f});
}

}  // namespace barchan
