// The predictor of the fluid step, and the drive.
#include "src/fluid/fluid_solver.hpp"
#include "src/parallel/cell_reductions.hpp"

namespace barchan {

namespace {

/// Weights of the explicit terms times dt; exact for rates linear in time also if dt changes.
AdamsBashforth weights(const FluidState& fluid, Real dt) {
  if (!fluid.has_history) return {dt, 0};
  const Real half = 0.5 * dt * dt / fluid.dt_previous;
  return {dt + half, -half};
}

}  // namespace

/// alpha u of the old time level near grains and bodies, with ghosts.
void FluidSolver::update_mass_flux(const FluidState& fluid) {
  const Region& around = regions_->fraction.dilated;
  // Walls are closed in every step: the workspace was lent.
  for_each_cell("fluid: nothing through the walls",
                CellRange{-1, grid_.nx + 1, 0, 1, -1, grid_.nz + 1},
                CloseFaces{workspace_.flux, workspace_.u_star.y, grid_.ny});
  for_each_cell("fluid: mass flux", around,
                MassFlux{grid_, fluid.u, fluid.alpha_f_previous, workspace_.flux});
  if (around.has_ghosts()) boundary_.fill_periodic(workspace_.flux);
}

/// c near grains and bodies, and how much a force along x and z adds to the flow.
void FluidSolver::update_mobility(const FluidState& fluid) {
  sum_vector("fluid: mobility", numbers_, kMobility, regions_->fraction.dilated,
             UpdateMobility{grid_, fluid.alpha_f, mobility_});
}

template <Fraction fraction, bool with_exchange>
Predict<fraction, with_exchange> FluidSolver::prediction(FluidState& fluid,
                                                         const ExchangeOnFaces& exchange, Real dt) {
  const FaceVector& flux = is_variable(fraction) ? workspace_.flux : fluid.u;
  const bool shared = exchange.alpha_raw.storage.size() > 0;
  const Field& share = shared ? exchange.alpha_raw : fluid.alpha_f_previous;
  return {.grid = grid_,
          .terms = {{grid_, fluid.u, flux},
                    {{grid_, share}, {grid_, fluid.u, fluid.nu_t, config_.kinematic_viscosity}}},
          .flux = flux,
          .alpha_new = {grid_, fluid.alpha_f},
          .rate = fluid.rate_previous,
          .u_star = workspace_.u_star,
          .impulse = exchange.impulse,
          .weight = weights(fluid, dt),
          .inv_density = 1 / config_.density};
}

void FluidSolver::predict(FluidState& fluid, Real dt) {
  if (fraction_varies_) update_mass_flux(fluid);
  const ExchangeOnFaces exchange = grains_ ? grains_->exchange() : ExchangeOnFaces{};
  const auto in_clear_fluid = prediction<Fraction::uniform, false>(fluid, exchange, dt);
  const auto near = prediction<Fraction::variable, false>(fluid, exchange, dt);
  const auto with_exchange = prediction<Fraction::variable, true>(fluid, exchange, dt);
  sum_each_cell("fluid: predict", numbers_, kPredictedRate, owned_cells(grid_),
                ByRegion{regions_->exchange.ref(), with_exchange, by_region(near, in_clear_fluid)});
  update_mobility(fluid);
  for (const auto& term : terms_) term->after_predict(step(fluid, dt));
  if (fraction_varies_ && regions_->fraction.dilated.has_ghosts())
    boundary_.fill_periodic(mobility_);
}

/// Flow rate and response to a force, as predictor, mobility and terms have added them up.
void FluidSolver::balance_flow_rate(const FluidState& fluid) {
  if (drive_.along_z()) {
    sum_each_cell("fluid: flow rate across", numbers_, kPredictedRate + 1, owned_cells(grid_),
                  FlowRateAcross{grid_, workspace_.u_star.z, fluid.alpha_f});
  }
  numbers_.combine(ranks_of(grid_), kPredictedRate, kMeanOfFluid - kPredictedRate, MPI_SUM);
  numbers_.fetch();
  const auto mobility = numbers_.get<Vec3>(kMobility);
  const auto [taken_rate, taken_along, taken_across] = numbers_.get<Vec3>(kTaken);
  const Real full = grid_.height_of_all_columns();
  flow_.height = full + mobility.y;
  // The rate across is a sum over what terms have left.
  flow_.rate = {numbers_.get(kPredictedRate) - taken_rate, numbers_.get(kPredictedRate + 1)};
  flow_.response = {full + mobility.x - taken_along, full + mobility.z - taken_across};
}

/// The force along x is added where the pressure is; across, it is added to u* here.
void FluidSolver::apply_drive(FluidState& fluid, Real dt) {
  balance_flow_rate(fluid);
  report_.wanted = drive_.target(fluid.time, fluid.bulk_at_start);
  fluid.drive = report_.drive = drive_.force(fluid, flow_, dt);
  flow_.rate.x += fluid.drive.x * dt * flow_.response.x;
  flow_.rate.z += fluid.drive.z * dt * flow_.response.z;
  report_.bulk_velocity = {flow_.rate.x / flow_.height, flow_.rate.z / flow_.height};
  if (!drive_.along_z()) return;
  for_each_cell("fluid: drive across", grid_, DriveAcross{workspace_.u_star.z, fluid.drive.z * dt});
  for (const auto& term : terms_) term->after_drive_across(step(fluid, dt));
}

}  // namespace barchan
