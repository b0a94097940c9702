#include "src/fluid/fluid_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/fluid/drag_between_rows.hpp"
#include "kernels/fluid/flow_sums.hpp"
#include "kernels/fluid/wale.hpp"
#include "src/base/stopwatch.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Of more use as scratch memory than three pieces.
FaceVector make_faces_in_one_piece(const char* label, const Grid& grid) {
  const Kokkos::View<Real****, Kokkos::LayoutLeft> all(label, grid.nx + 2, grid.ny + 2, grid.nz + 2,
                                                       3);
  const auto component = [&all](int c) {
    return Field(Kokkos::subview(all, Kokkos::ALL, Kokkos::ALL, Kokkos::ALL, c));
  };
  return {component(0), component(1), component(2)};
}

/// Weights of the explicit terms times dt; exact for rates linear in time also if dt changes.
AdamsBashforth weights(const FluidState& fluid, Real dt) {
  if (!fluid.has_history) return {dt, 0};
  const Real half = 0.5 * dt * dt / fluid.dt_previous;
  return {dt + half, -half};
}

void fill_fraction_ghosts(const Boundary& boundary, FluidState& fluid) {
  boundary.fill(fluid.alpha_f, FieldKind::scalar);
  boundary.fill(fluid.alpha_f_previous, FieldKind::scalar);
}

}  // namespace

void fill_ghosts(const Boundary& boundary, FluidState& fluid) {
  for_each_fluid_field(fluid, [&](auto& member, const FluidField& field) {
    if (field.ghosts != Ghosts::none) boundary.fill(member, field.ghosts);
  });
}

Real bulk_velocity(const FluidState& fluid) {
  const Grid& grid = fluid.grid;
  const Real flow =
      sum_each_cell("fluid: flow rate", grid, FlowRate{grid, fluid.u.x, fluid.alpha_f});
  return flow / sum_each_cell("fluid: volume", grid, HeightSum{grid, fluid.alpha_f});
}

FluidSolver::FluidSolver(const Config& config, const Grid& grid)
    : config_(config.fluid.value()),
      tolerance_(config.solver.pressure_tolerance),
      grid_(grid),
      boundary_(grid, config_.bottom, config_.top, config_.top_velocity),
      fft_(std::make_shared<const PlaneFft>(grid)),
      pressure_(grid, boundary_.halo(), fft_, config.solver),
      u_star_(make_faces_in_one_piece("fluid: u star", grid)),
      flux_(config.grains ? make_faces_in_one_piece("fluid: alpha u", grid) : FaceVector{}),
      mobility_(config.grains ? make_faces_in_one_piece("fluid: mobility", grid) : FaceVector{}),
      source_("fluid: pressure source", grid),
      c_w_delta_("fluid: filter width", grid.ny) {
  Kokkos::parallel_for("fluid: filter width", grid.ny,
                       FilterWidth{grid, config_.wale_constant, c_w_delta_});
}

FluidStepReport FluidSolver::advance(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  report_ = {};
  if (exchange != nullptr) fill_fraction_ghosts(boundary_, fluid);
  if (fluid.time == 0) fluid.bulk_at_start = bulk_velocity(fluid);
  update_eddy_viscosity(fluid);                    // nu_t
  predict(fluid, exchange, dt);                    // u*
  choose_drive(fluid, exchange, dt);               // f that gives the wanted bulk velocity
  solve_pressure(fluid, exchange != nullptr, dt);  // p
  correct(fluid, exchange != nullptr, dt);         // u, du/dt
  fluid.has_history = true;
  fluid.dt_previous = dt;
  fluid.time += dt;
  return report_;
}

void FluidSolver::remove_divergence(FluidState& fluid) {
  FluidState work = make_fluid_state(grid_);  // its pressure is not that of the flow
  work.u = fluid.u;
  work.alpha_f = work.alpha_f_previous = fluid.alpha_f;
  fill_ghosts(work);
  Kokkos::deep_copy(u_star_.x.storage, fluid.u.x.storage);
  Kokkos::deep_copy(u_star_.y.storage, fluid.u.y.storage);
  Kokkos::deep_copy(u_star_.z.storage, fluid.u.z.storage);
  const bool with_grains = mobility_.x.storage.size() > 0;
  if (with_grains) update_mobility(work);
  solve_pressure(work, with_grains, 1);
  correct(work, with_grains, 1);
}

void FluidSolver::update_eddy_viscosity(FluidState& fluid) const {
  if (config_.turbulence == Turbulence::none) return;
  for_each_cell("fluid: eddy viscosity", grid_,
                UpdateEddyViscosity{grid_, fluid.u, fluid.nu_t, c_w_delta_.data()});
  boundary_.fill(fluid.nu_t, FieldKind::eddy_viscosity);
}

/// alpha u of the old time level, with ghosts.
void FluidSolver::update_mass_flux(const FluidState& fluid) {
  // Scratch memory: others may have used these fields since.
  for_each_cell("fluid: nothing through the walls",
                CellRange{-1, grid_.nx + 1, 0, 1, -1, grid_.nz + 1},
                CloseFaces{flux_, u_star_.y, grid_.ny});
  for_each_cell("fluid: mass flux", grid_, MassFlux{grid_, fluid.u, fluid.alpha_f_previous, flux_});
  boundary_.fill_periodic(flux_);
}

void FluidSolver::predict(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  const auto run = [&](auto with_exchange, const FaceVector& flux, const Field& stress_share,
                       const ExchangeOnFaces& on_faces) {
    flow_rate_ =
        sum_each_cell("fluid: predict", grid_,
                      Predict<decltype(with_exchange)::value>{
                          .grid = grid_,
                          .convection = {grid_, fluid.u, flux},
                          .stress = {grid_, fluid.u, fluid.nu_t, config_.kinematic_viscosity},
                          .stress_share = stress_share,
                          .alpha_new = fluid.alpha_f,
                          .rate = fluid.rate_previous,
                          .u_star = u_star_,
                          .impulse = on_faces.impulse,
                          .weight = weights(fluid, dt),
                          .inv_density = 1 / config_.density});
  };
  if (exchange == nullptr) {
    run(std::false_type{}, fluid.u, fluid.alpha_f, {});
  } else {
    update_mass_flux(fluid);
    const bool shared = exchange->stress_share.storage.size() > 0;
    run(std::true_type{}, flux_, shared ? exchange->stress_share : fluid.alpha_f_previous,
        *exchange);
    drag_between_rows(fluid, *exchange);
  }
}

/// Moves momentum within columns alone, so the flow rate stays.
void FluidSolver::drag_between_rows(const FluidState& fluid, const ExchangeOnFaces& exchange) {
  if (exchange.conductance_x.storage.size() == 0) return;
  for (const bool along_x : {true, false}) {
    const Field& conductance = along_x ? exchange.conductance_x : exchange.conductance_z;
    for_each_cell("fluid: drag between rows", CellRange{0, grid_.nx, 0, 1, 0, grid_.nz},
                  DragBetweenRows{.grid = grid_,
                                  .conductance = conductance,
                                  .alpha = fluid.alpha_f,
                                  .u = along_x ? fluid.u.x : fluid.u.z,
                                  .density = config_.density,
                                  .along_x = along_x,
                                  .u_star = along_x ? u_star_.x : u_star_.z,
                                  .pivot = source_});
  }
}

/// Returns the flow rate per unit of drive times dt.
Real FluidSolver::update_mobility(const FluidState& fluid) {
  const Real response =
      sum_each_cell("fluid: mobility", grid_, UpdateMobility{grid_, fluid.alpha_f, mobility_});
  boundary_.fill_periodic(mobility_);
  return response;
}

void FluidSolver::choose_drive(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  Real drive_response = grid_.height_of_all_columns();
  fluid_height_ = drive_response;
  if (exchange != nullptr) {
    drive_response = update_mobility(fluid);
    fluid_height_ = sum_each_cell("fluid: volume", grid_, HeightSum{grid_, fluid.alpha_f});
  }
  if (config_.pressure_gradient) {
    fluid.drive = *config_.pressure_gradient / config_.density;
  } else if (config_.mean_velocity != 0) {
    const Real share =
        config_.ramp_time > 0 ? std::min(Real(1), fluid.time / config_.ramp_time) : Real(1);
    const Real bulk = fluid.bulk_at_start + share * (config_.mean_velocity - fluid.bulk_at_start);
    // A bed takes part of what the drive gives, as the pressure drop over it does; about what it
    // took last.
    const Real wanted = bulk * fluid_height_ + fluid.flow_missed;
    fluid.drive = (wanted - flow_rate_) / (drive_response * dt);
  } else {
    fluid.drive = 0;
  }
  report_.drive = fluid.drive;
  flow_rate_ += fluid.drive * dt * drive_response;
  report_.bulk_velocity = flow_rate_ / fluid_height_;
}

/// Total pressure: every step solves for all of it. p_previous becomes the last one.
void FluidSolver::solve_pressure(FluidState& fluid, bool coupled, Real dt) {
  const ScopedSeconds timer(report_.seconds_pressure);
  std::swap(fluid.p, fluid.p_previous);
  boundary_.halo().fill(u_star_.x);
  boundary_.halo().fill(u_star_.z);
  PressureReport solved;
  if (!coupled) {
    for_each_cell("fluid: pressure source", grid_,
                  pressure_source<false>(u_star_, fluid, fluid.drive, dt));
    solved = pressure_.solve_uniform(source_, fluid.p);
  } else {
    if (fluid.has_history) {
      for_each_cell("fluid: extrapolate pressure", grid_,
                    Combine{2, fluid.p_previous, -1, fluid.p});
    } else {
      Kokkos::deep_copy(fluid.p.storage, fluid.p_previous.storage);
    }
    for_each_cell("fluid: pressure source", grid_,
                  pressure_source<true>(u_star_, fluid, fluid.drive, dt));
    solved = pressure_.solve(mobility_, source_, fluid.p, tolerance_);
  }
  report_.pressure_iterations = solved.iterations;
  report_.pressure_residual = solved.residual;
  boundary_.fill(fluid.p, FieldKind::scalar);
}

template <bool with_grains>
PressureSource<with_grains> FluidSolver::pressure_source(const FaceVector& u,
                                                         const FluidState& fluid, Real drive,
                                                         Real dt) {
  return {.grid = grid_,
          .u = u,
          .alpha = fluid.alpha_f,
          .alpha_before = with_grains ? fluid.alpha_f_previous : fluid.alpha_f,
          .c = with_grains ? mobility_ : u,
          .drive_dt = drive * dt,
          .density = config_.density,
          .dt = dt,
          .b = source_};
}

void FluidSolver::correct(FluidState& fluid, bool coupled, Real dt) {
  report_.courant = max_each_cell("fluid: correct velocity", grid_,
                                  CorrectVelocity{.grid = grid_,
                                                  .u_star = u_star_,
                                                  .p = fluid.p,
                                                  .inv_density = 1 / config_.density,
                                                  .drive_dt = fluid.drive * dt,
                                                  .dt = dt,
                                                  .u = fluid.u,
                                                  .du_dt = fluid.du_dt});
  boundary_.fill_velocity(fluid.u);
  const auto residual = [&](const auto& continuity) {
    report_.continuity_residual = max_each_cell("fluid: continuity", grid_, continuity);
  };
  if (!coupled) {
    residual(ContinuityResidual<false>{pressure_source<false>(fluid.u, fluid, 0, dt)});
    return;
  }
  boundary_.fill_acceleration(fluid.du_dt);
  residual(ContinuityResidual<true>{pressure_source<true>(fluid.u, fluid, 0, dt)});
  const Real flow =
      sum_each_cell("fluid: flow rate", grid_, FlowRate{grid_, fluid.u.x, fluid.alpha_f});
  fluid.flow_missed = flow_rate_ - flow;
  report_.bulk_velocity = flow / fluid_height_;
}

Real FluidSolver::friction_velocity(const FluidState& fluid) const {
  int walls = 0;
  Real slope = 0;  // sum over the walls of the mean [1/s]
  const auto add = [&](WallFlow wall, int row, Real u_wall) {
    if (wall != WallFlow::no_slip) return;
    const WallShear shear{.grid = grid_, .u = fluid.u.x, .row = row, .u_wall = u_wall};
    slope += std::abs(sum_each_cell("fluid: wall shear", grid_, shear)) /
             (Real(grid_.nx_all) * grid_.nz_all);
    ++walls;
  };
  add(config_.bottom, 0, 0);
  add(config_.top, grid_.ny - 1, config_.top_velocity);
  return walls == 0 ? 0 : std::sqrt(config_.kinematic_viscosity * slope / walls);
}

Real FluidSolver::kinetic_energy(const FluidState& fluid) const {
  return config_.density * grid_.dx * grid_.dz *
         sum_each_cell("fluid: kinetic energy", grid_,
                       KineticEnergy{grid_, fluid.u, fluid.alpha_f});
}

}  // namespace barchan
