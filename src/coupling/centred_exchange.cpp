#include "src/coupling/centred_exchange.hpp"

#include <utility>

#include "src/parallel/cell_reductions.hpp"

namespace barchan {

CentredExchange::CentredExchange(const FlowAndGrains& of, VoidFraction void_fraction, bool smooths)
    : CentredExchange(of,
                      {.points = void_fraction == VoidFraction::centre ? PointModel::centre
                                                                       : PointModel::divided},
                      smooths) {}

void CentredExchange::gather(const FluidState& fluid, GrainState& grains, Real dt) {
  begin_gather(fluid, grains);
  pressure_gradient(fluid, grains);
  stress(fluid, grains);
  flow_at_grains(fluid, grains);
  gather_.act_on(grains, dt, sums_);
}

void CentredExchange::deposit(const GrainState& grains, FluidState& fluid, Real dt) {
  const ExchangeOfGrain of_grain = begin_deposit(grains, dt);
  deposit_.find_cells(sums_);
  find_faces();
  deposit_.add(of_grain, CellExchange{grid_.stencil}, grains.n);
  deposit_.update_fraction(fluid, sums_);
  to_faces();
  end_deposit(dt);
}

void CentredExchange::pressure_gradient(const FluidState& fluid, const GrainState& grains) {
  if (!gather_.forces().pressure_gradient) return;
  gather_.pressure_on_solid(fluid, sums_);
  at_centres(fields_.pressure_on_faces, grains, gather_.flow().pressure);
}

void CentredExchange::stress(const FluidState& fluid, const GrainState& grains) {
  const ActiveRegion& where = fields_.of_fraction;
  gather_.stress_and_convection(fluid, where.dilated);
  if (!gather_.forces().stress) return;
  gather_.stress_on_solid(fluid.alpha_f, where, sums_);
  at_centres(fields_.stress_on_faces, grains, gather_.flow().stress);
}

void CentredExchange::at_centres(const FaceVector& force, const GrainState& grains,
                                 const Kokkos::View<Vec3*>& at) const {
  Kokkos::parallel_for("coupling: force at grains", items(grains.n),
                       AtCentres{grid_.grid, grid_.box, force, grains.kin, at});
}

void CentredExchange::flow_at_grains(const FluidState& fluid, const GrainState& grains) {
  Kokkos::parallel_for("coupling: solid at grains", items(grains.n),
                       FlowOverCells{.stencil = grid_.stencil,
                                     .alpha_f = fluid.alpha_f,
                                     .alpha_raw = fields_.raw_fraction(fluid),
                                     .grains = grains.kin,
                                     .flow = gather_.flow(),
                                     .part = grains.fluid.part});
  Kokkos::parallel_for(
      "coupling: flow at grains", items(grains.n),
      FlowAtCentres{grid_.grid, grid_.box, fluid.u, fluid.du_dt, fields_.convective, fluid.alpha_f,
                    grains.kin, gather_.flow()});
}

/// Finds the cells where the flow meets the exchange, and the cells whose content reaches their
/// faces.
void CentredExchange::find_faces() {
  FlowRegions& flow = fields_.of_flow;
  flow.exchange.set(smooths_ ? flow.fraction.cells.columns() : fields_.deposited.columns());
  fields_.of_impulse.set(flow.exchange.columns().dilated(1));
}

/// Brings the impulse to faces, half of a cell's content to each of its two; adds up what the fluid
/// loses [N s].
void CentredExchange::to_faces() {
  const Region& cells = fields_.of_impulse;
  CellVector& impulse = fields_.impulse_in_cells;
  for (const auto& [quantity, field] :
       {std::pair{Deposits::kImpulseX, &impulse.x}, std::pair{Deposits::kImpulseY, &impulse.y},
        std::pair{Deposits::kImpulseZ, &impulse.z}}) {
    deposit_.decode(quantity, fields_.deposited, cells, *field);
    if (smooths_) grid_.smoother.solve(*field, fields_.smoothed);
  }
  grid_.fill_ghosts(impulse, cells);
  sum_vector("coupling: spread to faces", sums_, ExchangeSums::kTakenFromFluid,
             fields_.of_flow.exchange,
             SpreadToFaces{.grid = grid_.grid,
                           .impulse_x = impulse.x,
                           .impulse_y = impulse.y,
                           .impulse_z = impulse.z,
                           .given = fields_.on_faces.impulse});
}

}  // namespace barchan
