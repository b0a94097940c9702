// Numbers of the flow that reports ask for.
#include <cmath>

#include "kernels/flow_sums.hpp"
#include "src/fluid_solver.hpp"
#include "src/launch.hpp"

namespace barchan {

Real FluidSolver::friction_velocity(const FluidState& fluid) const {
  const bool bottom = config_.bottom == WallFlow::no_slip, top = config_.top == WallFlow::no_slip;
  const int walls = (bottom ? 1 : 0) + (top ? 1 : 0);
  if (walls == 0) return 0;
  const Real sum =
      sum_each_cell("fluid: wall shear", grid_, WallShear{grid_, fluid.u.x, bottom, top});
  const Real mean = sum / (Real(walls) * grid_.nx * grid_.nz);
  return std::sqrt(config_.kinematic_viscosity * std::abs(mean));
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
