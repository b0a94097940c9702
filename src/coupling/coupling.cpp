#include "src/coupling/coupling.hpp"

#include <algorithm>
#include <cmath>

#include "src/config/derived.hpp"
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
      box_(grid.box(config.grains->boundary_x == GrainBoundaryX::periodic)),
      stencil_(make_deposit_stencil(config, grid, grains.r_max)),
      by_row_(exchanges_by_row(config_)),
      halo_(grid, Deposits::kQuantities),
      rho_f_(config.fluid->density),
      nu_(config.fluid->kinematic_viscosity),
      floor_(config.fluid->bottom == WallFlow::no_slip),
      weight_{.gravity = {config.grains->gravity[0], config.grains->gravity[1],
                          config.grains->gravity[2]},
              .displaced = forces_.buoyancy ? rho_f_ : 0},
      force_(solver.idle().faces[0]),
      convective_(solver.idle().faces[1]),
      cells_{solver.idle().cells[0], solver.idle().cells[1], solver.idle().cells[2]},
      on_faces_{make_faces("exchange impulse", grid)} {
  if (config_.smoothing_length > 0) unsmoothed_ = Field("coupling: unsmoothed fraction", grid);
  if (by_row_) {
    on_faces_.stress_share = unsmoothed_;
    on_faces_.conductance_x = Field("coupling: conductance between rows, x", grid);
    on_faces_.conductance_z = Field("coupling: conductance between rows, z", grid);
  }
  deposits_.sum = decltype(deposits_.sum)("deposits", CellIndex::count(grid));
  deposits_.volume =
      fixed_point_for(static_cast<Real>(grains.n_initial) * sphere_volume(grains.r_max));
}

ExchangeOfGrain Coupling::of_grain(const GrainState& grains, Real dt) const {
  return {.dt = dt, .grains = grains.kin, .on_grains = grains.fluid, .exchange = grains.exchange};
}

ExchangeByRow Coupling::rows(const FluidState& fluid) const {
  return {.on = by_row_,
          .stencil = stencil_,
          .box = box_,
          .u = fluid.u,
          .alpha_f = local_fraction(fluid)};
}

void Coupling::add_up_grains(const GrainState& grains, const FluidState& fluid, Real dt) {
  // Bounds of what one cell can receive: everything.
  std::vector<Real> sum(6);
  Kokkos::parallel_reduce("coupling: totals", items(grains.n), GrainTotals{of_grain(grains, dt)},
                          sum[0], sum[1], sum[2], sum[3], sum[4], sum[5],
                          Kokkos::Min<Real>(extent_.left), Kokkos::Max<Real>(extent_.right),
                          Kokkos::Max<Real>(extent_.top), Kokkos::Min<Real>(extent_.front),
                          Kokkos::Max<Real>(extent_.back));
  sum_over(ranks_of(grid_), sum);
  // Those of all ranks: a neighbour's grains read from the outermost cells of this one.
  const MPI_Comm ranks = ranks_of(grid_);
  extent_ = {.left = -max_over(ranks, -extent_.left),
             .right = max_over(ranks, extent_.right),
             .top = max_over(ranks, extent_.top),
             .front = -max_over(ranks, -extent_.front),
             .back = max_over(ranks, extent_.back)};
  deposits_.conductance = fixed_point_for(sum[1] * (kDividedOffsets * kDividedOffsets / 4));
  // Rows exchange no more than by twice the fastest velocity along x and z.
  const Real fastest =
      by_row_ ? max_each_cell("coupling: fastest", grid_, FastestAlong{fluid.u}) : Real(0);
  deposits_.impulse = fixed_point_for(sum[2] + 4 * fastest * sum[1]);
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
  add_up_grains(grains, fluid, dt);
  Kokkos::deep_copy(deposits_.sum, 0);
  using Deposit = DepositGrains<runs_on_host ? 128 : 1>;
  Kokkos::parallel_for("coupling: deposit", items(Deposit::items_for(grains.n)),
                       Deposit{.of_grain = of_grain(grains, dt),
                               .rows = rows(fluid),
                               .deposits = deposits_,
                               .n = grains.n});
  halo_.scatter_add(deposits_.sum);
  update_fraction(fluid);
  spread_exchange();
  sum_faces();
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

/// The exchange on faces from the deposited impulse, and what couples rows.
void Coupling::spread_exchange() {
  int quantity = 3;
  for (Field* component : {&cells_.x, &cells_.y, &cells_.z}) {
    decode(quantity++, deposits_.impulse, *component);
    if (!by_row_) boundary_.fill(*component, FieldKind::scalar);
  }
  for_each_cell("coupling: spread to faces", grid_,
                SpreadToFaces{.grid = grid_,
                              .by_row = by_row_,
                              .impulse_x = cells_.x,
                              .impulse_y = cells_.y,
                              .impulse_z = cells_.z,
                              .given = on_faces_.impulse});
  if (!by_row_) return;
  decode(1, deposits_.conductance, on_faces_.conductance_x);
  decode(2, deposits_.conductance, on_faces_.conductance_z);
}

void Coupling::start(const GrainState& grains, FluidState& fluid) {
  deposit(grains, fluid, 0);
  Kokkos::deep_copy(fluid.alpha_f_previous.storage, fluid.alpha_f.storage);
  first_ = true;
}

void Coupling::sum_faces() {
  const auto sum = [&](Real Vec3::*axis, Field FaceVector::*faces) {
    ledger_.taken_from_fluid.*axis =
        -sum_each_cell("ledger: taken from the fluid", grid_,
                       SumImpulse{grid_, faces == &FaceVector::y, on_faces_.impulse.*faces});
  };
  sum(&Vec3::x, &FaceVector::x);
  sum(&Vec3::y, &FaceVector::y);
  sum(&Vec3::z, &FaceVector::z);
}

}  // namespace barchan
