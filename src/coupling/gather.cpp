// From the flow to the grains.
#include "kernels/coupling/gather.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/coupling/gather_shear.hpp"
#include "src/coupling/coupling.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

/// The cells whose faces the grains read.
CellRange Coupling::cells_around(const GrainExtent& grains) const {
  CellRange cells = owned_cells(grid_);
  if (!(grains.left <= grains.right)) return cells;  // no grains
  // One more on either side, and above one for faces; everything where that reaches a periodic
  // side.
  const auto shrink = [](Real low, Real high, Real spacing, int n_all, int mine, int& first,
                         int& last) {
    const Real begin = std::floor(low / spacing) - 1, end = std::floor(high / spacing) + 3;
    if (!(begin >= 0 && end <= n_all)) return;
    const int n = last;
    first = std::clamp(static_cast<int>(begin) - mine, 0, n);
    last = std::clamp(static_cast<int>(end) - mine, first, n);
  };
  shrink(grains.left, grains.right, grid_.dx, grid_.nx_all, grid_.i_begin, cells.i0, cells.i1);
  shrink(grains.front, grains.back, grid_.dz, grid_.nz_all, grid_.k_begin, cells.k0, cells.k1);
  cells.j1 = std::min(grid_.ny, rows_.row_of(grains.top) + 3);
  return cells;
}

/// A density on the faces of `cells`: what the solid fraction 1 - alpha takes of it to the ledger;
/// and to the grains. By row the way is that of their volume to alpha, backwards, from the cells
/// x, y, z on (FlowOverCells): so the grains get what the solid fraction takes.
void Coupling::gather_density(const GrainState& grains, const CellRange& cells, const Field& alpha,
                              FaceVector& on_cells, bool smoothed, Real dt,
                              const Kokkos::View<Vec3*>& at) {
  for_each_cell("coupling: force density at the walls",
                CellRange{cells.i0, cells.i1, 0, 1, cells.k0, cells.k1},
                HoldForceAtWall{force_.y, grid_.ny});
  for (Field* component : {&force_.x, &force_.y, &force_.z})
    boundary_.fill(*component, FieldKind::scalar);  // behind both walls constant, too
  auto& [x, y, z] = on_cells;
  ledger_.flow_on_solid += dt * sum_vector("coupling: force density on cells", grid_, cells,
                                           ForceOnCells{grid_, force_, alpha, x, y, z});
  if (!by_row_) {
    Kokkos::parallel_for("coupling: force at grains", items(grains.n),
                         AtCentres{grid_, box_, force_, grains.kin, at});
    return;
  }
  for (Field* component : {&x, &y, &z}) {
    if (smoothed) smoother_.solve(*component, *component);
    if (grid_.ranks) boundary_.fill(*component, FieldKind::scalar);
  }
}

void Coupling::pressure_at(const FluidState& fluid, const GrainState& grains,
                           const CellRange& around, Real dt) {
  if (!forces_.pressure_gradient) return;
  const bool smoothed = by_row_ && config_.smoothing_length > 0;
  const CellRange cells = smoothed ? owned_cells(grid_) : around;
  for_each_cell(
      "coupling: pressure force density", cells,
      PressureForceDensity{
          .grid = grid_, .p = fluid.p, .rho_f = rho_f_, .drive = fluid.drive, .force = force_});
  gather_density(grains, cells, fluid.alpha_f, cells_, smoothed, dt, flow_at_.pressure);
}

/// And the convective acceleration.
void Coupling::stress_at(const FluidState& fluid, const GrainState& grains, const CellRange& cells,
                         Real dt) {
  for_each_cell("coupling: stress force density", cells,
                StressForceDensity{.grid = grid_,
                                   .u = fluid.u,
                                   .stress = {grid_, fluid.u, fluid.nu_t, nu_},
                                   .rho_f = rho_f_,
                                   .force = force_,
                                   .convective = convective_});
  for (Field* component : {&convective_.x, &convective_.y, &convective_.z})
    boundary_.fill(*component, FieldKind::scalar);
  if (forces_.stress) {
    const Field& alpha = by_row_ ? local_fraction(fluid) : fluid.alpha_f;
    // The impulse of the last step is done with.
    gather_density(grains, cells, alpha, on_faces_.impulse, false, dt, flow_at_.stress);
  }
}

void Coupling::flow_at(const FluidState& fluid, const GrainState& grains, Real dt) {
  const auto read = [&](const auto& reading) {
    Kokkos::parallel_for("coupling: flow at grains", items(grains.n), reading);
  };
  const auto& kin = grains.kin;
  const auto& [px, py, pz] = cells_;
  const auto& [sx, sy, sz] = on_faces_.impulse;
  const FlowOverCells over_cells{.stencil = stencil_,
                                 .alpha_f = fluid.alpha_f,
                                 .unsmoothed = local_fraction(fluid),
                                 .with_pressure = by_row_ && forces_.pressure_gradient,
                                 .with_stress = by_row_ && forces_.stress,
                                 .pressure = {px, py, pz},
                                 .stress = {sx, sy, sz},
                                 .grains = kin,
                                 .flow = flow_at_};
  if (by_row_) {
    read(FlowOfRows{over_cells, box_, fluid.u, fluid.du_dt, convective_});
  } else {
    read(over_cells);
    read(FlowAtCentres{grid_, box_, fluid.u, fluid.du_dt, convective_, fluid.alpha_f, kin,
                       flow_at_});
  }
  if (config_.void_fraction == VoidFraction::cfdem_faithful) {
    auto& [x, y, z] = cells_;
    for_each_cell("coupling: velocity on cells", grid_, CentreVelocity{fluid.u, x, y, z});
    boundary_.fill(x, FieldKind::velocity_x);
    for (Field* component : {&y, &z}) boundary_.fill(*component, FieldKind::velocity_z);
    read(FlowFromCells{grid_, box_, x, y, z, fluid.alpha_f, kin, flow_at_});
  }
  std::vector<Real> sum(3);
  Kokkos::parallel_reduce("ledger: force of the flow", items(grains.n), SumOfForces{kin, flow_at_},
                          sum[0], sum[1], sum[2]);
  sum_over(ranks_of(grid_), sum);
  ledger_.flow_on_grains = dt * Vec3{sum[0], sum[1], sum[2]};
}

WallFaces Coupling::wall_faces(bool wall, bool along_x) const {
  if (!wall) return {};
  const int n = along_x ? grid_.nx : grid_.nz;
  if (!grid_.ranks) return {0, n};
  const RankLine& line = along_x ? grid_.ranks->along_x() : grid_.ranks->along_z();
  WallFaces faces;
  if (line.position == 0) faces.first = 0;
  if (line.position + 1 == line.count) faces.last = n;
  return faces;
}

void Coupling::unsmooth(const FluidState& fluid) {
  const Real length = config_.smoothing_length;
  if (length == 0) return;
  for_each_cell("coupling: unsmoothed fraction", grid_,
                UnsmoothedFraction{.grid = grid_,
                                   .alpha_f = fluid.alpha_f,
                                   .length_squared = length * length,
                                   .walls_x = wall_faces(walls_.x, true),
                                   .walls_z = wall_faces(walls_.z, false),
                                   .unsmoothed = unsmoothed_});
  boundary_.fill(unsmoothed_, FieldKind::scalar);
}

void Coupling::reserve_flow_at(int n) {
  for (auto* array :
       {&flow_at_.u, &flow_at_.du_dt, &flow_at_.u_grad_u, &flow_at_.pressure, &flow_at_.stress})
    reserve_rows(*array, n);
  for (auto* array : {&flow_at_.alpha_f, &flow_at_.alpha_l, &flow_at_.solid_per_fluid})
    reserve_rows(*array, n);
}

void Coupling::gather_shear(const FluidState& fluid, GrainState& grains) const {
  Kokkos::parallel_for("coupling: gather shear", items(grains.n),
                       GatherShear{.grid = grid_,
                                   .box = box_,
                                   .u = fluid.u,
                                   .rho_f = rho_f_,
                                   .mu_f = rho_f_ * nu_,
                                   .lift = forces_.lift,
                                   .torque = forces_.torque,
                                   .floor = floor_,
                                   .grains = grains.kin,
                                   .on_grains = grains.fluid,
                                   .exchange = grains.exchange});
}

void Coupling::gather(const FluidState& fluid, GrainState& grains, Real dt) {
  ledger_ = ExchangeLedger{};
  reserve_flow_at(grains.n);
  unsmooth(fluid);
  const CellRange around = cells_around(extent_);
  pressure_at(fluid, grains, around, dt);
  stress_at(fluid, grains, around, dt);
  flow_at(fluid, grains, dt);
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
  if (first_) {
    Kokkos::parallel_for("coupling: gather in the first step", items(grains.n),
                         GatherFirstStep{.rho_f = rho_f_,
                                         .weight = weight_,
                                         .grains = grains.kin,
                                         .flow_at = flow_at_,
                                         .on_grains = grains.fluid,
                                         .exchange = grains.exchange});
  }
  if (forces_.lift || forces_.torque) gather_shear(fluid, grains);
  first_ = false;
}

}  // namespace barchan
