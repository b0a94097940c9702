#include "src/coupling/gather.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/coupling/beside_bodies.hpp"
#include "kernels/coupling/force_density.hpp"
#include "kernels/coupling/gather_shear.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/tally_cells.hpp"

namespace barchan {

namespace {

FluidForces forces_of(const ForceSwitches& f) {
  return {f.drag,   f.pressure_gradient, f.stress, f.added_mass, f.buoyancy, f.lift,
          f.torque, f.wall_drag};
}

}  // namespace

Gather::Gather(const Config& config, const GrainState& grains, const CouplingGrid& grid,
               CouplingFields& fields)
    : grid_(grid),
      fields_(fields),
      forces_(forces_of(config.coupling.forces)),
      drag_(DragLaws::make(config.coupling.drag, grains.sauter_diameter)),
      weight_{.gravity = {config.grains->gravity[0], config.grains->gravity[1],
                          config.grains->gravity[2]},
              .displaced = forces_.buoyancy ? Real(config.fluid->density) : 0},
      rho_f_(config.fluid->density),
      nu_(config.fluid->kinematic_viscosity),
      has_floor_(config.fluid->bottom == WallFlow::no_slip),
      reads_as_cfdem_(config.coupling.void_fraction == VoidFraction::cfdem_faithful) {}

void Gather::operator()(const FluidState& fluid, GrainState& grains, Real dt,
                        const ExchangeSums& sums) {
  reserve_flow_at(grains.n);
  pressure_gradient(fluid, grains, sums);
  stress(fluid, grains, sums);
  flow_at_grains(fluid, grains);
  Kokkos::parallel_reduce("ledger: force of the flow", items(grains.n),
                          SumOfForces{grains.kin, flow_at_},
                          sums.into<Vec3>(ExchangeSums::kForceOnGrains));
  drag_and_share(grains, dt);
  if (forces_.lift || forces_.torque) lift_and_torque(fluid, grains);
  is_first_step_ = false;
}

void Gather::reserve_flow_at(int n) {
  for (auto* array :
       {&flow_at_.u, &flow_at_.du_dt, &flow_at_.u_grad_u, &flow_at_.pressure, &flow_at_.stress})
    reserve_entries(*array, n);
  for (auto* array : {&flow_at_.alpha_f, &flow_at_.alpha_l, &flow_at_.solid_per_fluid})
    reserve_entries(*array, n);
}

void Gather::undo_smoothing(const FluidState& fluid) {
  const Real length = grid_.smoothing_length;
  if (length == 0) return;
  const Region& cells = fields_.of_fraction.around;
  for_each_cell("coupling: fraction before smoothing", cells,
                UnsmoothedFraction{.grid = grid_.grid,
                                   .alpha_f = fluid.alpha_f,
                                   .length_squared = length * length,
                                   .walls_x = grid_.wall_faces_x(),
                                   .walls_z = grid_.wall_faces_z(),
                                   .unsmoothed = fields_.alpha_before_smoothing});
  if (grid_.kept.storage.size() > 0)
    for_each_cell("coupling: fraction beside bodies", cells,
                  FractionBesideBodies{grid_.kept, fields_.alpha_before_smoothing});
  grid_.boundary.fill_scalars(cells, fields_.alpha_before_smoothing);
}

/// By row the grains get it the way that their volume went to alpha_f, backwards: smoothed, then
/// from their cells (FlowOverCells). So they get what the solid fraction takes.
void Gather::pressure_gradient(const FluidState& fluid, const GrainState& grains,
                               const ExchangeSums& sums) {
  if (!forces_.pressure_gradient) return;
  if (grid_.by_row && grid_.walls == EvenExtension{} && grid_.bodies == nullptr)
    return smoothed_pressure_gradient(fluid, sums);
  const auto& [cells, and_faces] = fields_.of_fraction;
  FaceVector& on_faces = fields_.pressure_on_faces;
  CellVector& in_cells = fields_.pressure_in_cells;
  for_each_cell("coupling: pressure force density", and_faces,
                PressureForceDensity{.grid = grid_.grid,
                                     .p = fluid.p,
                                     .rho_f = rho_f_,
                                     .drive = fluid.drive,
                                     .force = on_faces});
  if (grid_.bodies) grid_.bodies->close(on_faces);  // there it pushes the body
  fill_faces_beside(on_faces, and_faces);
  to_cells(on_faces, fluid.alpha_f, cells, in_cells, sums, ExchangeSums::kPressureOnSolid);
  if (!grid_.by_row) return at_centres(on_faces, grains, flow_at_.pressure);
  for (Field* component : {&in_cells.x, &in_cells.y, &in_cells.z}) {
    grid_.smoother.solve(*component, cells);
    grid_.raise_to_kept(*component, cells);
  }
  if (grid_.grid.ranks) grid_.fill_ghosts(in_cells, cells);
}

/// The same in two solves for three: without walls of the grains the smoothing commutes with
/// differences along the floor.
void Gather::smoothed_pressure_gradient(const FluidState& fluid, const ExchangeSums& sums) {
  const auto& [cells, around] = fields_.of_fraction;
  CellVector& in_cells = fields_.pressure_in_cells;
  Field& p = fields_.smoothed_pressure;
  PressureForceInCell force{
      .grid = grid_.grid, .p = fluid.p, .rho_f = rho_f_, .drive = fluid.drive};
  sum_vector("coupling: pressure to smooth", sums, ExchangeSums::kPressureOnSolid, around,
             PressureToSmooth{.force = force, .alpha_f = fluid.alpha_f, .p = p, .y = in_cells.y});
  for (Field* f : {&p, &in_cells.y}) grid_.smoother.solve(*f, cells);
  grid_.boundary.fill_scalars(around, p);
  force.p = p;
  const Region& of_grains = fields_.of_grains.cells;
  for_each_cell("coupling: smoothed pressure force", of_grains,
                SmoothedPressureForce{.force = force, .x = in_cells.x, .z = in_cells.z});
  if (grid_.grid.ranks) grid_.fill_ghosts(in_cells, of_grains);
}

/// And the convective acceleration. By row the solid takes of the stress what it has before the
/// smoothing, so there is none beyond the cells of the grains.
void Gather::stress(const FluidState& fluid, const GrainState& grains, const ExchangeSums& sums) {
  const auto& [cells, and_faces] = grid_.by_row ? fields_.of_grains : fields_.of_fraction;
  FaceVector& on_faces = fields_.stress_on_faces;
  CellVector& in_cells = fields_.stress_in_cells;
  for_each_cell("coupling: stress force density", and_faces,
                StressForceDensity{.grid = grid_.grid,
                                   .u = fluid.u,
                                   .stress = {grid_.grid, fluid.u, fluid.nu_t, nu_},
                                   .rho_f = rho_f_,
                                   .force = on_faces,
                                   .convective = fields_.convective});
  grid_.fill_ghosts(fields_.convective, and_faces);
  if (!forces_.stress) return;
  const Field& alpha = grid_.by_row ? fields_.alpha_l(fluid) : fluid.alpha_f;
  fill_faces_beside(on_faces, and_faces);
  to_cells(on_faces, alpha, cells, in_cells, sums, ExchangeSums::kStressOnSolid);
  if (!grid_.by_row) return at_centres(on_faces, grains, flow_at_.stress);
  if (grid_.grid.ranks) grid_.fill_ghosts(in_cells, cells);
}

/// Constant behind both walls, and ghosts.
void Gather::fill_faces_beside(FaceVector& force, const Region& cells) const {
  for_each_column("coupling: force density at the walls", cells,
                  HoldForceAtWall{force.y, grid_.grid.ny});
  grid_.fill_ghosts(force, cells);
}

/// Adds up what the solid fraction 1 - alpha takes of it [N].
void Gather::to_cells(const FaceVector& force, const Field& alpha, const Region& cells,
                      CellVector& in_cells, const ExchangeSums& sums, ExchangeSums::Sum sum) const {
  sum_vector("coupling: force density on cells", sums, sum, cells,
             ForceOnCells{grid_.grid, force, alpha, in_cells.x, in_cells.y, in_cells.z});
}

void Gather::at_centres(const FaceVector& force, const GrainState& grains,
                        const Kokkos::View<Vec3*>& at) const {
  Kokkos::parallel_for("coupling: force at grains", items(grains.n),
                       AtCentres{grid_.grid, grid_.box, force, grains.kin, at});
}

void Gather::flow_at_grains(const FluidState& fluid, const GrainState& grains) {
  const auto read = [&](const auto& reading) {
    Kokkos::parallel_for("coupling: flow at grains", items(grains.n), reading);
  };
  const FlowOverCells over_cells{.stencil = grid_.stencil,
                                 .alpha_f = fluid.alpha_f,
                                 .unsmoothed = fields_.alpha_l(fluid),
                                 .with_pressure = grid_.by_row && forces_.pressure_gradient,
                                 .with_stress = grid_.by_row && forces_.stress,
                                 .pressure = fields_.pressure_in_cells,
                                 .stress = fields_.stress_in_cells,
                                 .grains = grains.kin,
                                 .flow = flow_at_};
  if (grid_.by_row) {
    read(FlowOfRows{over_cells, grid_.box, fluid.u, fluid.du_dt, fields_.convective, grid_.crowded,
                    fields_.solid_x, fields_.solid_z});
    return;
  }
  read(over_cells);
  read(FlowAtCentres{grid_.grid, grid_.box, fluid.u, fluid.du_dt, fields_.convective, fluid.alpha_f,
                     grains.kin, flow_at_});
  if (reads_as_cfdem_) flow_of_cfdem(fluid, grains);
}

void Gather::flow_of_cfdem(const FluidState& fluid, const GrainState& grains) {
  auto& [x, y, z] = fields_.velocity_in_cells;
  for_each_cell("coupling: velocity on cells", grid_.grid, CentreVelocity{fluid.u, x, y, z});
  grid_.boundary.fill(x, FieldKind::velocity_x);
  for (Field* component : {&y, &z}) grid_.boundary.fill(*component, FieldKind::velocity_z);
  Kokkos::parallel_for(
      "coupling: flow at grains", items(grains.n),
      FlowFromCells{grid_.grid, grid_.box, x, y, z, fluid.alpha_f, grains.kin, flow_at_});
}

void Gather::drag_and_share(const GrainState& grains, Real dt) const {
  std::visit(
      [&](const auto& law) {
        Kokkos::parallel_for("coupling: gather", items(grains.n),
                             GatherFluid{.law = law,
                                         .rho_f = rho_f_,
                                         .mu_f = rho_f_ * nu_,
                                         .dt = dt,
                                         .weight = weight_,
                                         .forces = forces_,
                                         .grains = grains.kin,
                                         .flow_at = flow_at_,
                                         .on_grains = grains.fluid,
                                         .exchange = grains.exchange});
      },
      drag_);
  if (!is_first_step_) return;
  Kokkos::parallel_for("coupling: gather in the first step", items(grains.n),
                       GatherFirstStep{.rho_f = rho_f_,
                                       .weight = weight_,
                                       .grains = grains.kin,
                                       .flow_at = flow_at_,
                                       .on_grains = grains.fluid,
                                       .exchange = grains.exchange});
}

void Gather::lift_and_torque(const FluidState& fluid, const GrainState& grains) const {
  Kokkos::parallel_for("coupling: gather shear", items(grains.n),
                       GatherShear{.grid = grid_.grid,
                                   .box = grid_.box,
                                   .u = fluid.u,
                                   .rho_f = rho_f_,
                                   .mu_f = rho_f_ * nu_,
                                   .lift = forces_.lift,
                                   .torque = forces_.torque,
                                   .floor = has_floor_,
                                   .grains = grains.kin,
                                   .on_grains = grains.fluid,
                                   .exchange = grains.exchange});
}

}  // namespace barchan
