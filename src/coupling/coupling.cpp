#include "src/coupling/coupling.hpp"

#include <algorithm>
#include <cmath>

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
      {DragLaw::gidaspow_blended, GidaspowBlended{}},
      {DragLaw::none, NoDrag{}}};
  return models.at(config.coupling.drag);
}

Real square(Real a) { return a * a; }

/// What stops grains stops what is smoothed, though the flow passes: the transforms of the flow,
/// or with walls others.
std::shared_ptr<const PlaneFft> smoothing_fft(const Config& config, const FluidSolver& solver,
                                              const Grid& grid, const Mirrors& walls) {
  if (walls == Mirrors{} || config.coupling.smoothing_length == 0) return solver.fft();
  return std::make_shared<const PlaneFft>(grid, walls);
}

}  // namespace

Coupling::Coupling(const Config& config, const FluidSolver& solver, const GrainState& grains,
                   const Grid& grid)
    : config_(config.coupling),
      forces_{config_.forces.drag,       config_.forces.pressure_gradient, config_.forces.stress,
              config_.forces.added_mass, config_.forces.buoyancy,          config_.forces.lift,
              config_.forces.torque,     config_.forces.wall_drag},
      drag_(make_drag(config, grains)),
      grid_(grid),
      rows_(grid.on_host()),
      boundary_(solver.boundary()),
      walls_{.x = config.grains->boundary_x == GrainBoundaryX::wall,
             .z = config.grains->boundary_z == GrainBoundaryZ::wall},
      smoother_(grid, smoothing_fft(config, solver, grid, walls_), 1,
                square(std::max<Real>(config_.smoothing_length, 1e-9))),
      always_skips_relaxation_(config.grains->frozen || !config.coupling.relaxation),
      skip_relaxation_(always_skips_relaxation_),
      box_(grid.box(config.grains->boundary_x == GrainBoundaryX::periodic)),
      stencil_(make_deposit_stencil(config, grid, grains.r_max)),
      by_row_(config_.exchange == Exchange::by_row && stencil_.points == PointSet::divided),
      halo_(grid, Deposits::kQuantities),
      rho_f_(config.fluid->density),
      nu_(config.fluid->kinematic_viscosity),
      floor_(config.fluid->bottom == WallFlow::no_slip),
      weight_{.gravity = {config.grains->gravity[0], config.grains->gravity[1],
                          config.grains->gravity[2]},
              .displaced = forces_.buoyancy ? rho_f_ : 0},
      force_(solver.idle().faces[0]),
      convective_(solver.idle().faces[1]),
      on_faces_{make_faces("exchange impulse", grid), make_faces("exchange implicit", grid)} {
  if (by_row_ && config_.smoothing_length > 0)
    on_faces_.stress_share = Field("coupling: unsmoothed fraction", grid);
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
  return {.on = by_row_, .stencil = stencil_, .box = box_, .u = fluid.u};
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
  Kokkos::parallel_for(
      "coupling: deposit", items(grains.n),
      DepositGrain{.of_grain = of_grain(grains, dt), .rows = rows(fluid), .deposits = deposits_});
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
