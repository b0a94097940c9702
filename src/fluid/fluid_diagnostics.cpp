// Numbers of the flow that reports ask for.
#include <cmath>

#include "kernels/fluid/flow_sums.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

Real FluidSolver::friction_velocity(const FluidState& fluid) const {
  int walls = 0;
  Real slope = 0;  // sum over the walls of the mean [1/s]
  const auto add = [&](WallFlow wall, int row, Real u_wall) {
    if (wall != WallFlow::no_slip) return;
    const WallShear shear{.grid = grid_, .u = fluid.u.x, .row = row, .u_wall = u_wall};
    slope += std::abs(sum_each_cell("fluid: wall shear", grid_, shear)) /
             (Real(grid_.nx_all) * grid_.nz_all);
    ++walls;
  };
  add(config_.bottom, 0, 0);
  add(config_.top, grid_.ny - 1, config_.top_velocity);
  return walls == 0 ? 0 : std::sqrt(config_.kinematic_viscosity * slope / walls);
}

Real FluidSolver::bulk_velocity(const FluidState& fluid) const {
  const Real flow =
      sum_each_cell("fluid: flow rate", grid_, FlowRate{grid_, fluid.u.x, fluid.alpha_f});
  return flow / sum_each_cell("fluid: volume", grid_, HeightSum{grid_, fluid.alpha_f});
}

Real FluidSolver::kinetic_energy(const FluidState& fluid) const {
  return config_.density * grid_.dx * grid_.dz *
         sum_each_cell("fluid: kinetic energy", grid_,
                       KineticEnergy{grid_, fluid.u, fluid.alpha_f});
}

}  // namespace barchan
