#include "src/fluid/fluid_solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernels/fluid/conjugate_gradients.hpp"
#include "kernels/fluid/flow_sums.hpp"
#include "kernels/fluid/wale.hpp"
#include "src/base/stopwatch.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "src/parallel/poison.hpp"

namespace barchan {

namespace {

/// Of more use as scratch memory than three pieces.
FaceVector make_faces_in_one_piece(const std::string& label, const Grid& grid) {
  const Kokkos::View<Real****, Kokkos::LayoutLeft> all(label, grid.nx + 2, grid.ny + 2, grid.nz + 2,
                                                       3);
  const auto component = [&all](int c) {
    return Field(Kokkos::subview(all, Kokkos::ALL, Kokkos::ALL, Kokkos::ALL, c));
  };
  return {component(0), component(1), component(2)};
}

}  // namespace

void fill_ghosts(const Boundary& boundary, FluidState& fluid) {
  for_each_fluid_field(fluid, [&](auto& member, const FluidField& field) {
    if (field.ghosts != Ghosts::none) boundary.fill(member, field.ghosts);
  });
}

FluidSolver::FluidSolver(const FluidCase& config, const Grid& grid)
    : FluidSolver(config, grid, config.with_grains ? Fraction::variable : Fraction::uniform) {}

FluidSolver::FluidSolver(const FluidCase& config, const Grid& grid, Fraction fraction)
    : config_(config.fluid),
      fraction_(config.bodies.n == 0 ? fraction : Fraction::variable),
      drive_(config_, config.schedule),
      tolerance_(config.solver.pressure_tolerance),
      grid_(grid),
      is_clear_(!is_variable(fraction)),
      everywhere_(grid),
      boundary_(grid, config_.bottom, config_.top, config_.top_velocity),
      fft_(std::make_shared<const PlaneFft>(grid)),
      pressure_(grid, boundary_.halo(), fft_, config.solver),
      u_star_(make_faces_in_one_piece("fluid: u star", grid)),
      flux_(is_variable(fraction_) ? make_faces_in_one_piece("fluid: alpha u", grid)
                                   : FaceVector{}),
      mobility_(is_variable(fraction_) ? make_faces_in_one_piece("fluid: mobility", grid)
                                       : FaceVector{}),
      source_("fluid: pressure source", grid),
      c_w_delta_("fluid: filter width", grid.ny),
      loads_(static_cast<std::size_t>(config.bodies.n)),
      numbers_("fluid: numbers",
               kLoads + BodiesInFlow::kNumbersOfLoad * static_cast<std::size_t>(config.bodies.n)) {
  if (config.bodies.n > 0) bodies_.emplace(Solids(config.bodies), grid, boundary_.halo(), config_);
  Kokkos::parallel_for("fluid: filter width", grid.ny,
                       FilterWidth{grid, config_.wale_constant, c_w_delta_});
}

void FluidSolver::set_solids(const Solids& solids) {
  const auto n = static_cast<std::size_t>(solids.count());
  bodies_.emplace(solids, grid_, boundary_.halo(), config_);
  is_clear_ = true;
  loads_.assign(n, {});
  numbers_ = DeviceReductions("fluid: numbers", kLoads + BodiesInFlow::kNumbersOfLoad * n);
}

FluidStepReport FluidSolver::advance(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  report_ = {};
  poison(u_star_);
  poison(flux_);
  poison(mobility_.x, mobility_.z, source_);  // mobility_.y is zero on the walls, once and for all
  const bool knows_where = exchange != nullptr && exchange->regions != nullptr;
  const bool bodies_alone = bodies_ && is_clear_ && exchange == nullptr;
  regions_ = knows_where ? exchange->regions : bodies_alone ? &bodies_->regions() : &everywhere_;
  if (bodies_) bodies_->forget_change(fluid.alpha_f, fluid.alpha_f_previous);
  if (is_variable(fraction_)) boundary_.fill_scalars(fluid.alpha_f, fluid.alpha_f_previous);
  if (fluid.time == 0)
    fluid.bulk_at_start = {bulk_velocity(fluid),
                           drive_.along_z() ? bulk_velocity_across(fluid) : 0};
  update_eddy_viscosity(fluid);  // nu_t
  predict(fluid, exchange, dt);  // u*
  update_mobility(fluid, dt);    // c of the pressure equation
  push(fluid, dt);               // f that gives the wanted bulk velocity
  solve_pressure(fluid, dt);     // p
  correct(fluid, dt);            // u, du/dt
  if (bodies_) loads_ = bodies_->loads(numbers_, kLoads);
  fluid.has_history = true;
  fluid.dt_previous = dt;
  fluid.time += dt;
  drive_.check(fluid.time, report_.wanted, report_.bulk_velocity);
  return report_;
}

void FluidSolver::remove_divergence(FluidState& fluid) {
  regions_ = &everywhere_;
  FluidState work = make_fluid_state(grid_);  // its pressure is not that of the flow
  work.u = fluid.u;
  work.alpha_f = work.alpha_f_previous = fluid.alpha_f;
  fill_ghosts(work);
  Kokkos::deep_copy(u_star_.x.storage, fluid.u.x.storage);
  Kokkos::deep_copy(u_star_.y.storage, fluid.u.y.storage);
  Kokkos::deep_copy(u_star_.z.storage, fluid.u.z.storage);
  update_mobility(work, 0);
  solve_pressure(work, 1);
  correct(work, 1);
}

void FluidSolver::flow_around_bodies(FluidState& fluid) {
  if (!bodies_) return;
  const auto bulk = [&] { return Vec2{bulk_velocity(fluid), bulk_velocity_across(fluid)}; };
  const Vec2 before = bulk();
  if (!bodies_->stop(fluid.u)) return;
  remove_divergence(fluid);
  const Vec2 now = bulk();
  const Real wanted = before.x * before.x + before.z * before.z;
  const Real there = before.x * now.x + before.z * now.z;
  if (wanted == 0 || there == 0) return;
  const Real scale = wanted / there;
  for (Field* f : {&fluid.u.x, &fluid.u.y, &fluid.u.z})
    for_each_cell("fluid: bulk velocity", grid_, Combine{scale, *f, 0, *f});
  boundary_.fill_velocity(fluid.u);
}

void FluidSolver::update_eddy_viscosity(FluidState& fluid) const {
  if (config_.turbulence == Turbulence::none) return;
  for_each_cell("fluid: eddy viscosity", grid_,
                UpdateEddyViscosity{grid_, fluid.u, fluid.nu_t, c_w_delta_.data()});
  if (bodies_) bodies_->clear(fluid.nu_t);
  boundary_.fill(fluid.nu_t, FieldKind::eddy_viscosity);
}

/// c near grains and bodies, and how much a force along x and z adds to the flow. What the walls of
/// bodies hold back in dt is taken from c and u*.
void FluidSolver::update_mobility(const FluidState& fluid, Real dt) {
  if (!is_variable(fraction_)) return;
  sum_vector("fluid: mobility", numbers_, kMobility, regions_->fraction.dilated,
             UpdateMobility{grid_, fluid.alpha_f, mobility_});
  if (bodies_) bodies_->hold_back(u_star_, mobility_, fluid.alpha_f, dt, numbers_, kHeld);
  if (regions_->fraction.dilated.has_ghosts()) boundary_.fill_periodic(mobility_);
}

/// What predictor and mobility added up.
void FluidSolver::find_driven_flow(const FluidState& fluid) {
  if (drive_.along_z()) {
    sum_each_cell("fluid: flow rate across", numbers_, kPredictedRate + 1, owned_cells(grid_),
                  FlowRateAcross{grid_, u_star_.z, fluid.alpha_f});
  }
  numbers_.combine(ranks_of(grid_), kPredictedRate, kMeanOfWater - kPredictedRate, MPI_SUM);
  numbers_.fetch();
  flow_.rate = {numbers_.get(kPredictedRate), numbers_.get(kPredictedRate + 1)};
  const auto mobility = numbers_.get<Vec3>(kMobility);
  const Real full = grid_.height_of_all_columns();
  flow_.response = {full + mobility.x, full + mobility.z};
  flow_.height = full + mobility.y;
  if (!bodies_) return;
  const auto [rate, along, across] = numbers_.get<Vec3>(kHeld);
  flow_.rate.x -= rate;  // that across is a sum over what is left
  flow_.response.x -= along, flow_.response.z -= across;
}

/// Along x the force is added where the pressure is; across, it is added to u* here.
void FluidSolver::push(FluidState& fluid, Real dt) {
  find_driven_flow(fluid);
  report_.wanted = drive_.target(fluid.time, fluid.bulk_at_start);
  fluid.drive = report_.drive = drive_.force(fluid, flow_, dt);
  flow_.rate.x += fluid.drive.x * dt * flow_.response.x;
  flow_.rate.z += fluid.drive.z * dt * flow_.response.z;
  report_.bulk_velocity = {flow_.rate.x / flow_.height, flow_.rate.z / flow_.height};
  if (!drive_.along_z()) return;
  for_each_cell("fluid: drive across", grid_, DriveAcross{u_star_.z, fluid.drive.z * dt});
  if (bodies_) bodies_->hold_back_across(u_star_.z, fluid.drive.z * dt, dt);
}

/// Total pressure: every step solves for all of it. p_previous becomes the last one.
void FluidSolver::solve_pressure(FluidState& fluid, Real dt) {
  const ScopedSeconds timer(report_.seconds_pressure);
  std::swap(fluid.p, fluid.p_previous);
  boundary_.halo().fill(u_star_.x, u_star_.z);
  const auto of_clear_water = pressure_source<Fraction::uniform>(u_star_, fluid, fluid.drive.x, dt);
  PressureReport solved;
  if (!is_variable(fraction_)) {
    for_each_cell("fluid: pressure source", grid_, of_clear_water);
    solved = pressure_.solve_uniform(source_, fluid.p);
  } else {
    const Real last = fluid.has_history ? 2 : 1, before = fluid.has_history ? -1 : 0;
    for_each_cell("fluid: extrapolate pressure", regions_->fraction.dilated,
                  Combine{last, fluid.p_previous, before, fluid.p});
    for_each_cell("fluid: pressure source", grid_,
                  ByRegion{regions_->fraction.cells.ref(),
                           pressure_source<Fraction::variable>(u_star_, fluid, fluid.drive.x, dt),
                           of_clear_water});
    if (bodies_) bodies_->take_mean_away(source_, numbers_, kMeanOfWater);
    solved = pressure_.solve(mobility_, regions_->fraction.cells, source_, fluid.p, tolerance_);
  }
  report_.pressure_iterations = solved.iterations;
  report_.pressure_residual = solved.residual;
  if (bodies_) bodies_->take_mean_away(fluid.p, numbers_, kMeanOfWater);
  boundary_.fill(fluid.p, FieldKind::scalar);
}

template <Fraction fraction>
PressureSource<fraction> FluidSolver::pressure_source(const FaceVector& u, const FluidState& fluid,
                                                      Real drive_x, Real dt) {
  return {.grid = grid_,
          .u = u,
          .alpha = fluid.alpha_f,
          .alpha_before = is_variable(fraction) ? fluid.alpha_f_previous : fluid.alpha_f,
          .c = is_variable(fraction) ? mobility_ : u,
          .drive_dt = drive_x * dt,
          .density = config_.density,
          .dt = dt,
          .b = source_};
}

template <Fraction fraction, bool with_bodies>
CorrectVelocity<fraction, with_bodies> FluidSolver::correction(FluidState& fluid, Real dt) {
  return {.grid = grid_,
          .u_star = u_star_,
          .p = fluid.p,
          .alpha = fluid.alpha_f,
          .c = with_bodies ? mobility_ : FaceVector{},
          .inv_density = 1 / config_.density,
          .drive_dt = fluid.drive.x * dt,
          .dt = dt,
          .u = fluid.u,
          .du_dt = fluid.du_dt};
}

void FluidSolver::correct(FluidState& fluid, Real dt) {
  const auto in_clear_water = correction<Fraction::uniform>(fluid, dt);
  const auto correct = [&](const auto& each_face) {
    largest_and_sums("fluid: correct velocity", numbers_, kCourant, owned_cells(grid_), each_face);
  };
  const RegionRef region = regions_->fraction.cells.ref();
  if (bodies_) {
    correct(ByRegion{region, correction<Fraction::variable, true>(fluid, dt), in_clear_water});
  } else if (is_variable(fraction_)) {
    correct(ByRegion{region, correction<Fraction::variable>(fluid, dt), in_clear_water});
  } else {
    correct(in_clear_water);
  }
  boundary_.fill_velocity(fluid.u);
  if (is_variable(fraction_)) boundary_.fill_acceleration(fluid.du_dt);
  measure(fluid, dt);
}

/// What is reported of a step.
void FluidSolver::measure(FluidState& fluid, Real dt) {
  const ContinuityResidual in_clear_water{
      pressure_source<Fraction::uniform>(fluid.u, fluid, 0, dt)};
  const auto residual = [&](const auto& continuity) {
    max_each_cell("fluid: continuity", numbers_, kContinuity, owned_cells(grid_), continuity);
  };
  if (is_variable(fraction_)) {
    const ContinuityResidual near_grains{
        pressure_source<Fraction::variable>(fluid.u, fluid, 0, dt)};
    residual(ByRegion{regions_->fraction.cells.ref(), near_grains, in_clear_water});
  } else {
    residual(in_clear_water);
  }
  if (bodies_) bodies_->add_loads(fluid, dt, numbers_, kLoads);
  numbers_.combine(ranks_of(grid_), kContinuity, 2, MPI_MAX);
  numbers_.combine(ranks_of(grid_), kNewRate, 2, MPI_SUM);
  numbers_.fetch();
  report_.continuity_residual = numbers_.get(kContinuity);
  report_.courant = numbers_.get(kCourant);
  if (!is_variable(fraction_)) return;
  const Vec2 flow{numbers_.get(kNewRate), drive_.along_z() ? numbers_.get(kNewRate + 1) : 0};
  fluid.flow_rate_defect = {flow_.rate.x - flow.x, flow_.rate.z - flow.z};
  report_.bulk_velocity = {flow.x / flow_.height, flow.z / flow_.height};
}

}  // namespace barchan
