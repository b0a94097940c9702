#include "src/coupling/gather.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/coupling/beside_bodies.hpp"
#include "kernels/coupling/force_density.hpp"
#include "kernels/coupling/gather_shear.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/cell_reductions.hpp"

namespace barchan {

namespace {

FluidForces forces_of(const ForceSwitches& f) {
  return {f.drag,   f.pressure_gradient, f.stress,           f.added_mass, f.buoyancy, f.lift,
          f.torque, f.wall_drag,         f.mixture_viscosity};
}

}  // namespace

Gather::Gather(const CoupledCase& config, const GrainState& grains, const CouplingGrid& grid,
               CouplingFields& fields, bool layers)
    : grid_(grid),
      fields_(fields),
      forces_(forces_of(config.coupling.forces)),
      drag_(DragLaws::make(config.coupling.drag, grains.sauter_diameter)),
      shape_{config.coupling.shape_drag},
      weight_{.gravity = {config.grains->grains.gravity[0], config.grains->grains.gravity[1],
                          config.grains->grains.gravity[2]},
              .displaced = forces_.buoyancy ? Real(config.fluid->fluid.density) : 0},
      rho_f_(config.fluid->fluid.density),
      nu_(config.fluid->fluid.kinematic_viscosity),
      has_floor_(config.fluid->fluid.bottom == WallFlow::no_slip),
      layers_(layers) {}

void Gather::act_on(GrainState& grains, Real dt, const ExchangeSums& sums) {
  Kokkos::parallel_reduce("ledger: force of the flow", items(grains.n),
                          SumOfForces{grains.kin, flow_at_},
                          sums.into<Vec3>(ExchangeSums::kForceOnGrains));
  drag_and_share(grains, dt);
  if (forces_.lift || forces_.torque) lift_and_torque(grains);
  is_first_step_ = false;
}

void Gather::reserve_flow(const GrainState& grains) {
  const int n = grains.n;
  for (auto* array :
       {&flow_at_.u, &flow_at_.du_dt, &flow_at_.u_grad_u, &flow_at_.pressure, &flow_at_.stress})
    reserve_entries(*array, n);
  for (auto* array : {&flow_at_.alpha_l, &flow_at_.alpha_o, &flow_at_.slip, &flow_at_.factor,
                      &flow_at_.solid_per_fluid})
    reserve_entries(*array, n);
  flow_at_.vorticity = forces_.torque ? grains.fluid.omega_f : grains.exchange.lift;
}

void Gather::undo_smoothing(const FluidState& fluid) {
  const Real length = grid_.smoothing_length;
  if (length == 0) return;
  const Region& cells = fields_.of_fraction.dilated;
  for_each_cell("coupling: raw fraction", cells,
                RawFraction{.grid = grid_.grid,
                            .alpha_f = fluid.alpha_f,
                            .length_squared = length * length,
                            .walls_x = grid_.wall_faces_x(),
                            .walls_z = grid_.wall_faces_z(),
                            .alpha_raw = fields_.alpha_raw});
  if (grid_.smoothing_weight.storage.size() > 0)
    for_each_cell("coupling: fraction beside bodies", cells,
                  FractionBesideBodies{grid_.smoothing_weight, fields_.alpha_raw});
  grid_.boundary.fill_scalars(cells, fields_.alpha_raw);
}

void Gather::pressure_on_solid(const FluidState& fluid, const ExchangeSums& sums) const {
  const auto& [cells, and_faces] = fields_.of_fraction;
  FaceVector& on_faces = fields_.pressure_on_faces;
  for_each_cell("coupling: pressure force density", and_faces,
                PressureForceDensity{.grid = grid_.grid,
                                     .p = fluid.p,
                                     .rho_f = rho_f_,
                                     .drive = fluid.drive,
                                     .force = on_faces});
  if (grid_.bodies) grid_.bodies->close(on_faces);  // closed faces push the body
  fill_faces_beside(on_faces, and_faces);
  to_cells(on_faces, fluid.alpha_f, cells, fields_.pressure_in_cells, sums,
           ExchangeSums::kPressureOnSolid);
}

void Gather::stress_and_convection(const FluidState& fluid, const Region& cells) const {
  for_each_cell("coupling: stress force density", cells,
                StressForceDensity{.grid = grid_.grid,
                                   .u = fluid.u,
                                   .stress = {grid_.grid, fluid.u, fluid.nu_t, nu_},
                                   .rho_f = rho_f_,
                                   .force = fields_.stress_on_faces,
                                   .convective = fields_.convective});
  grid_.fill_ghosts(fields_.convective, cells);
}

void Gather::stress_on_solid(const Field& alpha, const ActiveRegion& where,
                             const ExchangeSums& sums) const {
  fill_faces_beside(fields_.stress_on_faces, where.dilated);
  to_cells(fields_.stress_on_faces, alpha, where.cells, fields_.stress_in_cells, sums,
           ExchangeSums::kStressOnSolid);
}

/// Fills the faces at both walls with those inside, and the ghosts.
void Gather::fill_faces_beside(FaceVector& force, const Region& cells) const {
  for_each_column("coupling: force density at the walls", cells,
                  HoldForceAtWall{force.y, grid_.grid.ny});
  grid_.fill_ghosts(force, cells);
}

/// Brings a force density to cells; adds up the part of the solid fraction 1 - alpha [N].
void Gather::to_cells(const FaceVector& force, const Field& alpha, const Region& cells,
                      CellVector& in_cells, const ExchangeSums& sums, ExchangeSums::Sum sum) const {
  sum_vector("coupling: force density on cells", sums, sum, cells,
             ForceOnCells{grid_.grid, force, alpha, in_cells.x, in_cells.y, in_cells.z});
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
                                         .shape = shape_,
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

void Gather::lift_and_torque(const GrainState& grains) const {
  std::visit(
      [&](const auto& law) {
        Kokkos::parallel_for("coupling: gather shear", items(grains.n),
                             GatherShear{.law = law,
                                         .rho_f = rho_f_,
                                         .mu_f = rho_f_ * nu_,
                                         .lift = forces_.lift,
                                         .torque = forces_.torque,
                                         .floor = has_floor_,
                                         .grains = grains.kin,
                                         .flow_at = flow_at_,
                                         .on_grains = grains.fluid,
                                         .exchange = grains.exchange});
      },
      drag_);
}

}  // namespace barchan
