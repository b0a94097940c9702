#include "src/coupling/cfdem_exchange.hpp"

namespace barchan {

void CfdemExchange::flow_at_grains(const FluidState& fluid, const GrainState& grains) {
  CentredExchange::flow_at_grains(fluid, grains);
  auto& [x, y, z] = fields_.velocity_in_cells;
  for_each_cell("coupling: velocity on cells", grid_.grid, CentreVelocity{fluid.u, x, y, z});
  grid_.boundary.fill(x, FieldKind::velocity_x);
  for (Field* component : {&y, &z}) grid_.boundary.fill(*component, FieldKind::velocity_z);
  Kokkos::parallel_for(
      "coupling: flow at grains", items(grains.n),
      FlowFromCells{grid_.grid, grid_.box, x, y, z, fluid.alpha_f, grains.kin, gather_.flow()});
}

}  // namespace barchan
