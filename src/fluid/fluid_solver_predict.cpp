// The predictor of the fluid step.
#include "kernels/fluid/interlayer_drag.hpp"
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

/// alpha u of the old time level near the grains, with ghosts.
void FluidSolver::update_mass_flux(const FluidState& fluid) {
  // Scratch memory: others may have used these fields since.
  for_each_cell("fluid: nothing through the walls",
                CellRange{-1, grid_.nx + 1, 0, 1, -1, grid_.nz + 1},
                CloseFaces{flux_, u_star_.y, grid_.ny});
  for_each_cell("fluid: mass flux", regions_->fraction.dilated,
                MassFlux{grid_, fluid.u, fluid.alpha_f_previous, flux_});
  if (regions_->fraction.dilated.has_ghosts()) boundary_.fill_periodic(flux_);
}

template <Fraction fraction, bool with_exchange>
Predict<fraction, with_exchange> FluidSolver::prediction(FluidState& fluid,
                                                         const ExchangeOnFaces* exchange, Real dt) {
  const bool shared = exchange != nullptr && exchange->stress_share.storage.size() > 0;
  return {.grid = grid_,
          .convection = {grid_, fluid.u, is_variable(fraction) ? flux_ : fluid.u},
          .stress = {grid_, fluid.u, fluid.nu_t, config_.kinematic_viscosity},
          .stress_share = shared ? exchange->stress_share : fluid.alpha_f_previous,
          .alpha_new = fluid.alpha_f,
          .rate = fluid.rate_previous,
          .u_star = u_star_,
          .impulse = with_exchange ? exchange->impulse : FaceVector{},
          .weight = weights(fluid, dt),
          .inv_density = 1 / config_.density};
}

void FluidSolver::predict(FluidState& fluid, const ExchangeOnFaces* exchange, Real dt) {
  const auto in_clear_water = prediction<Fraction::uniform, false>(fluid, exchange, dt);
  const auto predict = [&](const auto& each_face) {
    sum_each_cell("fluid: predict", numbers_, kPredictedRate, owned_cells(grid_), each_face);
  };
  if (is_variable(fraction_)) update_mass_flux(fluid);
  if (exchange != nullptr) {
    predict(ByRegion{
        regions_->exchange.ref(), prediction<Fraction::variable, true>(fluid, exchange, dt),
        ByRegion{regions_->fraction.cells.ref(),
                 prediction<Fraction::variable, false>(fluid, exchange, dt), in_clear_water}});
    interlayer_drag(fluid, *exchange);
  } else if (is_variable(fraction_)) {
    predict(ByRegion{regions_->fraction.cells.ref(),
                     prediction<Fraction::variable, false>(fluid, exchange, dt), in_clear_water});
  } else {
    predict(in_clear_water);
  }
}

/// Moves momentum within columns alone, so the flow rate stays.
void FluidSolver::interlayer_drag(const FluidState& fluid, const ExchangeOnFaces& exchange) {
  if (exchange.conductance_x.storage.size() == 0) return;
  for (const bool along_x : {true, false}) {
    const Field& conductance = along_x ? exchange.conductance_x : exchange.conductance_z;
    for_each_column("fluid: interlayer drag", regions_->exchange,
                    InterlayerDrag{.grid = grid_,
                                   .rows = regions_->exchange.range().j1,
                                   .conductance = conductance,
                                   .alpha = fluid.alpha_f,
                                   .u = along_x ? fluid.u.x : fluid.u.z,
                                   .density = config_.density,
                                   .along_x = along_x,
                                   .u_star = along_x ? u_star_.x : u_star_.z,
                                   .pivot = source_});
  }
}

}  // namespace barchan
