#include "src/coupling/coupling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/config/load.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

DragModel make_drag(const Config& config, const GrainState& grains) {
  const std::map<DragLaw, DragModel> models{
      {DragLaw::gidaspow, Gidaspow{}},
      {DragLaw::di_felice, DiFelice{}},
      {DragLaw::koch_hill, KochHill{}},
      {DragLaw::syamlal_obrien, SyamlalOBrien{}},
      {DragLaw::beetstra, Beetstra{.d_mean = grains.sauter_diameter}},
      {DragLaw::paper_repaired, PaperRepaired{}},
      {DragLaw::none, NoDrag{}}};
  return models.at(config.coupling.drag);
}

Real square(Real a) { return a * a; }

}  // namespace

DepositStencil make_deposit_stencil(const Config& config, const Grid& grid, Real r_max) {
  const bool periodic_x = config.grains->boundary_x == GrainBoundaryX::periodic;
  const VoidFraction kind = config.coupling.void_fraction;
  DepositStencil stencil = deposit_stencil_in(grid, PointSet::divided, periodic_x);
  if (kind == VoidFraction::centre) stencil.points = PointSet::centre;
  if (kind == VoidFraction::cfdem_faithful) stencil.points = PointSet::cfdem;
  if (!grid.ranks) return stencil;
  const Real reach = kOuterShell * r_max;
  if (reach > std::min(grid.dx, grid.dz)) {
    throw ConfigError({fmt::format(
        "--ranks: cells of {:.3g} x {:.3g} m are smaller than the radius of the largest grain, "
        "{:.3g} m: start this case with --ranks 1, or with wider cells (fluid.cells)",
        grid.dx, grid.dz, r_max)});
  }
  const RankLine &along_x = grid.ranks->along_x(), &along_z = grid.ranks->along_z();
  if (along_x.count > 1) {
    stencil.box.lx = 0;
    if (periodic_x || along_x.position > 0) stencil.i_low = -1;
    if (periodic_x || along_x.position + 1 < along_x.count) stencil.i_high = grid.nx;
  }
  if (along_z.count > 1) {
    stencil.box.lz = 0;
    stencil.k_low = -1, stencil.k_high = grid.nz;
  }
  return stencil;
}

Coupling::Coupling(const Config& config, const FluidSolver& solver, const GrainState& grains,
                   const Grid& grid)
    : config_(config.coupling),
      forces_{config_.forces.drag, config_.forces.pressure_gradient, config_.forces.stress,
              config_.forces.added_mass, config_.forces.buoyancy},
      drag_(make_drag(config, grains)),
      grid_(grid),
      rows_(grid.on_host()),
      boundary_(solver.boundary()),
      smoother_(grid, solver.fft(), 1, square(std::max(config_.smoothing_length, 1e-9))),
      always_skips_relaxation_(config.grains->frozen || !config.coupling.relaxation),
      skip_relaxation_(always_skips_relaxation_),
      box_(grid.box(config.grains->boundary_x == GrainBoundaryX::periodic)),
      stencil_(make_deposit_stencil(config, grid, grains.r_max)),
      halo_(grid, Deposits::kQuantities),
      rho_f_(config.fluid->density),
      nu_(config.fluid->kinematic_viscosity),
      weight_{.gravity = {config.grains->gravity[0], config.grains->gravity[1],
                          config.grains->gravity[2]},
              .displaced = forces_.buoyancy ? rho_f_ : 0},
      force_(solver.idle().faces[0]),
      convective_(solver.idle().faces[1]),
      on_faces_{make_faces("exchange impulse", grid), make_faces("exchange implicit", grid)} {
  cell_[0] = Field("coupling: cell density", grid);
  std::copy_n(solver.idle().cells.begin(), 3, cell_ + 1);
  deposits_.sum = decltype(deposits_.sum)("deposits", CellIndex::count(grid));
  deposits_.volume =
      fixed_point_for(static_cast<Real>(grains.n_initial) * sphere_volume(grains.r_max));
}

ExchangeOfGrain Coupling::of_grain(const GrainState& grains, Real dt) const {
  return {.dt = dt, .grains = grains.kin, .on_grains = grains.fluid, .exchange = grains.exchange};
}

ExchangeByRow Coupling::rows(const FluidState& fluid) const {
  return {.on = config_.exchange == Exchange::by_row && stencil_.points == PointSet::divided,
          .stencil = stencil_,
          .box = box_,
          .u = fluid.u};
}

void Coupling::gather(const FluidState& fluid, GrainState& grains, Real dt) {
  force_density(fluid, grains, forces_);
  const ReadingFromCells cells = velocity_on_cells(fluid);
  std::visit(
      [&](const auto& law) {
        Kokkos::parallel_for("coupling: gather", items(grains.n),
                             GatherFluid{.drag = law,
                                         .grid = grid_,
                                         .box = box_,
                                         .u = fluid.u,
                                         .force = force_,
                                         .convective = convective_,
                                         .alpha_f = fluid.alpha_f,
                                         .rho_f = rho_f_,
                                         .mu_f = rho_f_ * nu_,
                                         .dt = dt,
                                         .weight = weight_,
                                         .forces = forces_,
                                         .rows = rows(fluid),
                                         .cells = cells,
                                         .skip_relaxation = skip_relaxation_,
                                         .grains = grains.kin,
                                         .on_grains = grains.fluid,
                                         .exchange = grains.exchange});
      },
      drag_);
  skip_relaxation_ = always_skips_relaxation_;
}

void Coupling::single_force(const FluidForces& which, const FluidState& fluid,
                            const GrainState& grains, const Kokkos::View<Vec3*>& force) {
  force_density(fluid, grains, which);
  Kokkos::parallel_for(
      "output: one fluid force", grains.n,
      FluidForceOnGrain{
          .grid = grid_, .box = box_, .density = force_, .grains = grains.kin, .force = force});
}

void Coupling::choose_scales(const GrainState& grains, const FluidState& fluid, Real dt) {
  // Bounds of what one cell can receive: everything.
  std::vector<Real> sum(6);
  Kokkos::parallel_reduce("coupling: totals", items(grains.n),
                          SumExchange{of_grain(grains, dt), rows(fluid)}, sum[0], sum[1], sum[2],
                          sum[3], sum[4], sum[5]);
  sum_over(ranks_of(grid_), sum);
  deposits_.implicit = fixed_point_for(sum[1]);
  deposits_.impulse = fixed_point_for(sum[2]);
  ledger_ = ExchangeLedger{};
  ledger_.grain_volume = sum[0];
  ledger_.given_to_grains = {sum[3], sum[4], sum[5]};
}

/// One quantity of the deposits as a density on cells, smoothed.
void Coupling::decode(int quantity, const FixedPoint& point, Field& density) const {
  DecodeDeposit functor{.grid = grid_,
                        .deposits = deposits_,
                        .point = point,
                        .quantity = quantity,
                        .density = density};
  if (quantity == 0 && config_.void_fraction == VoidFraction::cfdem_faithful) {
    functor.most = kMostSolid;
  }
  for_each_cell("coupling: decode deposit", grid_, functor);
  if (smooths(quantity)) smoother_.solve(density, density);
}

void Coupling::deposit(const GrainState& grains, FluidState& fluid, Real dt) {
  choose_scales(grains, fluid, dt);
  Kokkos::deep_copy(deposits_.sum, 0);
  Kokkos::parallel_for("coupling: deposit", items(grains.n),
                       DepositGrain{.stencil = stencil_,
                                    .of_grain = of_grain(grains, dt),
                                    .rows = rows(fluid),
                                    .deposits = deposits_});
  halo_.scatter_add(deposits_.sum);
  update_fraction(fluid);
  spread_exchange();
}

/// alpha_f from the deposited volume.
void Coupling::update_fraction(FluidState& fluid) {
  std::swap(fluid.alpha_f, fluid.alpha_f_previous);
  decode(0, deposits_.volume, fluid.alpha_f);
  ledger_.deposited_volume = sum_each_cell("coupling: solid fraction to fluid fraction", grid_,
                                           SolidToFluidFraction{grid_, fluid.alpha_f});
  boundary_.fill(fluid.alpha_f, FieldKind::scalar);
  if (!config_.alpha_time_derivative) {  // the fraction counts as if it had always been the new one
    Kokkos::deep_copy(fluid.alpha_f_previous.storage, fluid.alpha_f.storage);
  }
}

/// The exchange on faces from the deposited implicit coefficient and impulse.
void Coupling::spread_exchange() {
  for (int q = 0; q < 4; ++q) {
    decode(q + 1, q == 0 ? deposits_.implicit : deposits_.impulse, cell_[q]);
    boundary_.fill(cell_[q], FieldKind::scalar);
  }
  for_each_cell("coupling: spread to faces", grid_,
                SpreadToFaces{.grid = grid_,
                              .implicit = cell_[0],
                              .impulse_x = cell_[1],
                              .impulse_y = cell_[2],
                              .impulse_z = cell_[3],
                              .a = on_faces_.impulse,
                              .m = on_faces_.implicit});
}

void Coupling::start(const GrainState& grains, FluidState& fluid) {
  deposit(grains, fluid, 0);
  Kokkos::deep_copy(fluid.alpha_f_previous.storage, fluid.alpha_f.storage);
  skip_relaxation_ = true;
}

void Coupling::sum_faces(Real dt, const FluidState& fluid) {
  const auto sum = [&](Real Vec3::*axis, Field FaceVector::*faces) {
    const FaceVolume volume{grid_, faces == &FaceVector::y};
    ledger_.taken_from_fluid.*axis = -sum_each_cell("ledger: taken from the fluid", grid_,
                                                    SumImpulse{volume, on_faces_.impulse.*faces});
    ledger_.implicit_on_fluid.*axis =
        dt * sum_each_cell("ledger: implicit drag", grid_,
                           SumImplicit{volume, on_faces_.implicit.*faces, fluid.du_dt.*faces});
  };
  sum(&Vec3::x, &FaceVector::x);
  sum(&Vec3::y, &FaceVector::y);
  sum(&Vec3::z, &FaceVector::z);
}

void Coupling::carry(const FluidState& fluid, GrainState& grains, Real dt) {
  for_each_cell("coupling: velocity change", grid_,
                VelocityChangeOnCells{.grid = grid_,
                                      .du_dt = fluid.du_dt,
                                      .dt = dt,
                                      .x = cell_[1],
                                      .y = cell_[2],
                                      .z = cell_[3]});
  for (int q = 1; q < 4; ++q) {
    if (smooths(q)) smoother_.solve(cell_[q], cell_[q]);
    if (grid_.ranks) boundary_.fill(cell_[q], FieldKind::scalar);  // grains read beyond the pencil
  }
  std::vector<Real> total(3);
  Kokkos::parallel_reduce("coupling: carry to grains", items(grains.n),
                          CarryToGrain{.stencil = stencil_,
                                       .of_grain = of_grain(grains, dt),
                                       .x = cell_[1],
                                       .y = cell_[2],
                                       .z = cell_[3],
                                       .carried_impulse = grains.exchange.carried_impulse},
                          total[0], total[1], total[2]);
  sum_over(ranks_of(grid_), total);
  ledger_.carried_to_grains = {total[0], total[1], total[2]};
  sum_faces(dt, fluid);
}

}  // namespace barchan
