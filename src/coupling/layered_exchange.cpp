#include "src/coupling/layered_exchange.hpp"

#include "kernels/coupling/force_density.hpp"
#include "src/parallel/cell_reductions.hpp"

namespace barchan {

namespace {

/// Tells if a momentum cell may get twice the grains that fit into it. Grains of diameter d lie a
/// diameter apart: in cells of width h, up to (h + d)/d per direction have their centres in one,
/// and h/d fit in.
bool may_be_oversubscribed(const Grid& grid, Real d) {
  return (1 + d / grid.dx) * (1 + d / grid.dz) > 2;
}

}  // namespace

LayeredExchange::LayeredExchange(const FlowAndGrains& of)
    : UnresolvedExchange(of, {.points = PointModel::divided}, true),
      oversubscribed_(may_be_oversubscribed(
          of.grid, 2 * of.grains.r_max * of.grains.shapes.over_largest_sphere)) {}

void LayeredExchange::gather(const FluidState& fluid, GrainState& grains, Real dt) {
  begin_gather(fluid, grains);
  if (oversubscribed_) solid_of_momentum_cells(fluid, grains);
  pressure_gradient(fluid);
  stress(fluid);
  flow_at_grains(fluid, grains);
  gather_.act_on(grains, dt, sums_);
}

void LayeredExchange::deposit(const GrainState& grains, FluidState& fluid, Real dt) {
  const ExchangeOfGrain of_grain = begin_deposit(grains, dt);
  max_each_cell("coupling: fastest", sums_, ExchangeSums::kFastest, fields_.of_fraction.dilated,
                FastestAlong{fluid.u});
  deposit_.find_cells(sums_);
  fields_.of_flow.exchange.set(fields_.deposited.columns());
  deposit_.add(of_grain, layers(fluid), grains.n);
  deposit_.update_fraction(fluid, sums_);
  to_faces();
  end_deposit(dt);
}

LayerExchange LayeredExchange::layers(const FluidState& fluid) const {
  return {.stencil = grid_.stencil,
          .box = grid_.box,
          .u = fluid.u,
          .alpha_f = fields_.raw_fraction(fluid)};
}

void LayeredExchange::solid_of_momentum_cells(const FluidState& fluid, const GrainState& grains) {
  const Region& cells = fields_.of_grains.dilated;
  deposit_.add_solid(layers(fluid), grains, cells);
  deposit_.decode(Deposits::kSolidX, cells, cells, fields_.solid_x);
  deposit_.decode(Deposits::kSolidZ, cells, cells, fields_.solid_z);
  grid_.boundary.fill_scalars(cells, fields_.solid_x, fields_.solid_z);
}

void LayeredExchange::pressure_gradient(const FluidState& fluid) {
  if (!gather_.forces().pressure_gradient) return;
  if (grid_.walls == EvenExtension{} && grid_.bodies == nullptr)
    return smoothed_pressure_gradient(fluid);
  gather_.pressure_on_solid(fluid, sums_);
  CellVector& in_cells = fields_.pressure_in_cells;
  const Region& cells = fields_.of_fraction.cells;
  for (Field* component : {&in_cells.x, &in_cells.y, &in_cells.z}) {
    grid_.smoother.solve(*component, cells);
    grid_.renormalise(*component, cells);
  }
  if (grid_.grid.ranks) grid_.fill_ghosts(in_cells, cells);
}

/// Smoothed pressure gradient in two solves instead of three: without walls of the grains the
/// smoothing commutes with differences along the floor.
void LayeredExchange::smoothed_pressure_gradient(const FluidState& fluid) {
  const auto& [cells, dilated] = fields_.of_fraction;
  CellVector& in_cells = fields_.pressure_in_cells;
  Field& p = fields_.smoothed_pressure;
  PressureForceInCell force{
      .grid = grid_.grid, .p = fluid.p, .rho_f = gather_.rho_f(), .drive = fluid.drive};
  sum_vector("coupling: pressure to smooth", sums_, ExchangeSums::kPressureOnSolid, dilated,
             PressureToSmooth{.force = force, .alpha_f = fluid.alpha_f, .p = p, .y = in_cells.y});
  for (Field* f : {&p, &in_cells.y}) grid_.smoother.solve(*f, cells);
  grid_.boundary.fill_scalars(dilated, p);
  force.p = p;
  const Region& of_grains = fields_.of_grains.cells;
  for_each_cell("coupling: smoothed pressure force", of_grains,
                SmoothedPressureForce{.force = force, .x = in_cells.x, .z = in_cells.z});
  if (grid_.grid.ranks) grid_.fill_ghosts(in_cells, of_grains);
}

/// Force of the stress on the solid. The solid takes the part that it has before the smoothing, so
/// there is none beyond the cells of the grains.
void LayeredExchange::stress(const FluidState& fluid) {
  const ActiveRegion& where = fields_.of_grains;
  gather_.stress_and_convection(fluid, where.dilated);
  if (!gather_.forces().stress) return;
  const Field& alpha = fields_.raw_fraction(fluid);
  gather_.stress_on_solid(alpha, where, sums_);
  if (grid_.grid.ranks) grid_.fill_ghosts(fields_.stress_in_cells, where.cells);
}

void LayeredExchange::flow_at_grains(const FluidState& fluid, const GrainState& grains) {
  const FlowOverCells over_cells{.stencil = grid_.stencil,
                                 .alpha_f = fluid.alpha_f,
                                 .alpha_raw = fields_.raw_fraction(fluid),
                                 .with_pressure = gather_.forces().pressure_gradient,
                                 .with_stress = gather_.forces().stress,
                                 .pressure = fields_.pressure_in_cells,
                                 .stress = fields_.stress_in_cells,
                                 .grains = grains.kin,
                                 .flow = gather_.flow(),
                                 .part = grains.fluid.part};
  Kokkos::parallel_for("coupling: flow at grains", items(grains.n),
                       LayeredFlow{over_cells, grid_.box, fluid.u, fluid.du_dt, fields_.convective,
                                   oversubscribed_, fields_.solid_x, fields_.solid_z});
}

/// Brings exchange and coefficients of the interlayer drag to faces; adds up what the fluid loses
/// [N s].
void LayeredExchange::to_faces() {
  ExchangeOnFaces& on_faces = fields_.on_faces;
  sum_vector("coupling: layers to faces", sums_, ExchangeSums::kTakenFromFluid,
             fields_.of_flow.exchange,
             LayersToFaces{.grid = grid_.grid,
                           .deposits = deposit_.sums(),
                           .given = on_faces.impulse,
                           .interlayer_drag_x = on_faces.interlayer_drag_x,
                           .interlayer_drag_z = on_faces.interlayer_drag_z});
}

}  // namespace barchan
