#include "src/fluid/fluid_solver.hpp"

#include <algorithm>
#include <utility>

#include "kernels/fluid/flow_sums.hpp"
#include "kernels/fluid/wale.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

/// In one piece, of more use to others while it is idle.
FaceVector make_faces(const char* label, const Grid& grid) {
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

}  // namespace

FluidSolver::FluidSolver(const Config& config, const Grid& grid)
    : config_(config.fluid.value()),
      solver_(config.solver),
      grid_(grid),
      boundary_(grid, config_.bottom, config_.top, config_.top_velocity),
      fft_(std::make_shared<const PlaneFft>(grid)),
      pressure_(grid, boundary_.halo(), fft_, config.solver),
      u_star_(make_faces("fluid: u star", grid)),
      source_("fluid: pressure source", grid),
      c_w_delta_("fluid: filter width", grid.ny) {
  Kokkos::parallel_for("fluid: filter width", grid.ny,
                       FilterWidth{grid, config_.wale_constant, c_w_delta_});
  if (config.grains) {
    flux_ = make_faces("fluid: alpha u", grid);
    mobility_ = make_faces("fluid: mobility", grid);
  }
}

FluidStepReport FluidSolver::advance(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  report_ = {};
  if (exchange != nullptr) {
    boundary_.fill(fluid.alpha_f, FieldKind::scalar);
    boundary_.fill(fluid.alpha_f_previous, FieldKind::scalar);
  }
  if (fluid.time == 0) fluid.bulk_at_start = bulk_velocity(fluid);
  update_eddy_viscosity(fluid);       // nu_t
  predict(fluid, exchange, dt);       // u*
  choose_drive(fluid, exchange, dt);  // f that gives the wanted bulk velocity
  project(fluid, exchange, dt);       // p, u, du/dt

  fluid.has_history = true;
  fluid.dt_previous = dt;
  fluid.time += dt;
  return report_;
}

void FluidSolver::fill_ghosts(const FluidState& fluid) const {
  boundary_.fill_velocity(fluid.u);
  for (const Field& f : {fluid.p, fluid.p_previous, fluid.alpha_f, fluid.alpha_f_previous}) {
    boundary_.fill(f, FieldKind::scalar);
  }
  boundary_.fill(fluid.nu_t, FieldKind::eddy_viscosity);
}

void FluidSolver::update_eddy_viscosity(const FluidState& fluid) {
  if (config_.turbulence == Turbulence::none) return;
  for_each_cell("fluid: eddy viscosity", grid_,
                UpdateEddyViscosity{grid_, fluid.u, fluid.nu_t, c_w_delta_.data()});
  boundary_.fill(fluid.nu_t, FieldKind::eddy_viscosity);
}

void FluidSolver::predict(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  const bool coupled = exchange != nullptr;
  if (coupled) {
    if (flux_.x.origin == nullptr) {
      flux_ = make_faces("fluid: alpha u", grid_);
      mobility_ = make_faces("fluid: mobility", grid_);
    }
    // Others may have used these fields since.
    for_each_cell("fluid: nothing through the walls",
                  CellRange{-1, grid_.nx + 1, 0, 1, -1, grid_.nz + 1},
                  CloseFaces{flux_, u_star_.y, grid_.ny});
    for_each_cell("fluid: mass flux", grid_,
                  MassFlux{grid_, fluid.u, fluid.alpha_f_previous, flux_});
    boundary_.fill_periodic(flux_);
  }
  const Convection convection{grid_, fluid.u, coupled ? flux_ : fluid.u};
  const StressDivergence stress{grid_, fluid.u, fluid.nu_t, config_.kinematic_viscosity};
  const AdamsBashforth weight = weights(fluid, dt);
  const Real per_density = 1 / config_.density;
  const auto run = [&](auto functor) {
    flow_rate_ = sum_each_cell("fluid: predict", grid_, functor);
  };
  if (coupled) {
    run(Predict<true>{grid_, convection, stress, fluid.alpha_f_previous, fluid.alpha_f,
                      fluid.rate_previous, u_star_, *exchange, weight, per_density});
  } else {
    run(Predict<false>{grid_,
                       convection,
                       stress,
                       fluid.alpha_f,
                       fluid.alpha_f,
                       fluid.rate_previous,
                       u_star_,
                       {},
                       weight,
                       per_density});
  }
}

Real FluidSolver::target_bulk_velocity(const FluidState& fluid) const {
  const Real share =
      config_.ramp_time > 0 ? std::min(Real(1), fluid.time / config_.ramp_time) : Real(1);
  return fluid.bulk_at_start + share * (config_.mean_velocity - fluid.bulk_at_start);
}

void FluidSolver::choose_drive(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  const Real all_height = grid_.height_of_all_columns();
  if (exchange != nullptr) {
    drive_response_ = sum_each_cell(
        "fluid: mobility", grid_,
        UpdateMobility{grid_, fluid.alpha_f, exchange->implicit, 1 / config_.density, mobility_});
    boundary_.fill_periodic(mobility_);
    fluid_height_ = sum_each_cell("fluid: volume", grid_, HeightSum{grid_, fluid.alpha_f});
  } else {
    drive_response_ = fluid_height_ = all_height;
  }
  if (config_.pressure_gradient) {
    fluid.drive = *config_.pressure_gradient / config_.density;
  } else if (config_.mean_velocity != 0) {
    // A bed takes part of what the drive gives, as the pressure drop over it does; about what it
    // took last.
    const Real wanted = target_bulk_velocity(fluid) * fluid_height_ + fluid.flow_missed;
    fluid.drive = (wanted - flow_rate_) / (drive_response_ * dt);
  } else {
    fluid.drive = 0;
  }
  report_.drive = fluid.drive;
  flow_rate_ += fluid.drive * dt * drive_response_;
  report_.bulk_velocity = flow_rate_ / fluid_height_;
}

void FluidSolver::project(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  // Total pressure: every step solves for all of it. p_previous becomes the last one.
  std::swap(fluid.p, fluid.p_previous);
  const Real drive_dt = fluid.drive * dt;
  boundary_.halo().fill(u_star_.x);
  boundary_.halo().fill(u_star_.z);
  const Kokkos::Timer timer;
  if (exchange == nullptr) {
    for_each_cell("fluid: pressure source", grid_,
                  pressure_source<false>(u_star_, fluid, drive_dt, dt));
    add_to_report(pressure_.solve_uniform(source_, fluid.p));
    report_.seconds_pressure = timer.seconds();
    correct<false>(fluid, exchange, dt, drive_dt);
    return;
  }
  if (fluid.has_history) {
    for_each_cell("fluid: extrapolate pressure", grid_,
                  ExtrapolatePressure{fluid.p_previous, fluid.p});
  } else {
    Kokkos::deep_copy(fluid.p.storage, fluid.p_previous.storage);
  }
  for_each_cell("fluid: pressure source", grid_,
                pressure_source<true>(u_star_, fluid, drive_dt, dt));
  add_to_report(pressure_.solve(mobility_, source_, fluid.p, solver_.pressure_tolerance));
  report_.seconds_pressure = timer.seconds();
  correct<true>(fluid, exchange, dt, drive_dt);
  const Real flow =
      sum_each_cell("fluid: flow rate", grid_, FlowRate{grid_, fluid.u.x, fluid.alpha_f});
  fluid.flow_missed = flow_rate_ - flow;
  report_.bulk_velocity = flow / fluid_height_;
}

void FluidSolver::add_to_report(const PressureReport& solved) {
  report_.pressure_iterations += solved.iterations;
  report_.pressure_residual = solved.residual;
}

template <bool with_grains>
PressureSource<with_grains> FluidSolver::pressure_source(const FaceVector& u,
                                                         const FluidState& fluid, Real drive_dt,
                                                         Real dt) const {
  const FaceVector& c = with_grains ? mobility_ : u;
  return {grid_,  u,        fluid.alpha_f,   with_grains ? fluid.alpha_f_previous : fluid.alpha_f,
          c,      drive_dt, config_.density, dt,
          source_};
}

template <bool with_grains>
void FluidSolver::correct(const FluidState& fluid, const ExchangeOnFaces* exchange, Real dt,
                          Real drive_dt) {
  const FaceVector& implicit = with_grains ? exchange->implicit : u_star_;
  boundary_.fill(fluid.p, FieldKind::scalar);
  report_.courant = max_each_cell(
      "fluid: correct velocity", grid_,
      CorrectVelocity<with_grains>{grid_, u_star_, fluid.p, fluid.alpha_f, implicit,
                                   1 / config_.density, drive_dt, dt, fluid.u, fluid.du_dt});
  boundary_.fill_velocity(fluid.u);
  boundary_.fill_periodic(fluid.du_dt);
  report_.continuity_residual = max_each_cell(
      "fluid: continuity", grid_,
      ContinuityResidual<with_grains>{pressure_source<with_grains>(fluid.u, fluid, 0, dt)});
}

}  // namespace barchan
