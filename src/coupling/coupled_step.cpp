#include "src/coupling/coupled_step.hpp"

#include "src/config/derived.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

template <class Action, class... Arrays>
void for_each(const Action& action, Arrays&... arrays) {
  (action(arrays), ...);
}

// What the two sides of the exchange need of a grain, and what they leave with it.
constexpr auto gather_needs = [](GrainState& s, const auto& action) {
  for_each(action, s.kin, s.fluid.u_f, s.exchange.fluid_force, s.exchange.carried_impulse);
};
constexpr auto gather_gives = [](GrainState& s, const auto& action) {
  for_each(action, s.fluid.u_f, s.fluid.beta, s.fluid.steady_force, s.fluid.added_mass,
           s.exchange.added_mass_force, s.exchange.fluid_force, s.exchange.carried_impulse);
};
constexpr auto deposit_needs = [](GrainState& s, const auto& action) {
  for_each(action, s.kin, s.fluid.beta, s.fluid.added_mass, s.fluid.drag_impulse, s.fluid.u_start,
           s.exchange.added_mass_force, s.exchange.carried_impulse);
};
constexpr auto carry_gives = [](GrainState& s, const auto& action) {
  action(s.exchange.carried_impulse);
};

}  // namespace

CoupledStep::CoupledStep(const Config& config, SystemState& state)
    : dt_(config.time.fluid_step), n_substeps_(grain_substeps(config.time)) {
  if (state.fluid) fluid_ = std::make_unique<FluidSolver>(config, state.fluid->grid);
  if (!state.grains) return;
  frozen_ = config.grains->frozen;
  grains_ = std::make_unique<GrainSolver>(config, *state.grains);
  const auto& g = config.grains->gravity;
  still_.weight.gravity = {g[0], g[1], g[2]};
  if (state.fluid) {
    add_fluid(*state.grains);
    add_exchange(*state.grains);
    fluid_side_ =
        FluidSideGrains(state.fluid->grid, config.grains->boundary_x == GrainBoundaryX::periodic);
    coupling_ = std::make_unique<Coupling>(config, *fluid_, *state.grains, state.fluid->grid);
    grains_->list().use_scratch(ScratchMemory(fluid_->idle().for_anything()));
  } else if (config.grains->ambient) {
    add_fluid(*state.grains);
    still_.rho_f = still_.weight.displaced = config.grains->ambient->density;
    still_.mu_f = still_.rho_f * config.grains->ambient->kinematic_viscosity;
  }
}

void CoupledStep::start(SystemState& state) {
  if (frozen_) {  // what does not move has no velocity, whatever its file says
    const auto kin = state.grains->kin;
    Kokkos::parallel_for(
        "grains: freeze", state.grains->n, KOKKOS_LAMBDA(int g) {
          kin(g).u = Vec3{};
          kin(g).omega = Vec3{};
        });
  }
  if (grains_) grains_->start(*state.grains);
  if (coupling_)
    coupling_->start(fluid_side_.to_fluid_ranks(*state.grains, deposit_needs), *state.fluid);
  if (fluid_) fluid_->fill_ghosts(*state.fluid);
}

void CoupledStep::advance(SystemState& state) {
  if (coupling_) {
    advance_coupled(*state.fluid, *state.grains);
  } else if (fluid_) {
    const PhaseTimer timer(phases_, "fluid");
    fluid_report_ = fluid_->advance(*state.fluid, nullptr, dt_);
  } else {
    advance_grains(*state.grains);
  }
  phases_["fluid"] -= fluid_report_.seconds_pressure;
  phases_["pressure"] += fluid_report_.seconds_pressure;
}

/// t -> t + dt: the grains move through the flow of time t, then the flow answers.
void CoupledStep::advance_coupled(FluidState& fluid, GrainState& grains) {
  {
    const PhaseTimer timer(phases_, "exchange");
    GrainState& there = fluid_side_.to_fluid_ranks(grains, gather_needs);
    coupling_->gather(fluid, there, dt_);  // u_f, drag coefficient, steady forces at the grains
    fluid_side_.to_grain_ranks(grains, gather_gives);
    if (fluid_side_.is_cut())
      Kokkos::parallel_for("grains: begin fluid step", items(grains.n),
                           BeginFluidStep{grains.kin, grains.fluid});
  }
  {
    const PhaseTimer timer(phases_, "grains");
    move_grains(grains);  // sub-steps; the drag follows the grain at fixed u_f
  }
  GrainState* there = nullptr;
  {
    const PhaseTimer timer(phases_, "deposit");
    there = &fluid_side_.to_fluid_ranks(grains, deposit_needs);
    coupling_->deposit(*there, fluid, dt_);  // alpha_f; -impulse and its implicit part on faces
  }
  {
    const PhaseTimer timer(phases_, "fluid");
    fluid_report_ = fluid_->advance(fluid, &coupling_->on_faces(), dt_);  // WALE, u*, p, u
  }
  const PhaseTimer timer(phases_, "exchange");
  coupling_->carry(fluid, *there, dt_);  // what the implicit drag moved goes to the grains next
  fluid_side_.to_grain_ranks(grains, carry_gives);
  ledger_.close_step(coupling_->ledger(), grains);
  grains_->remove_left(grains);
}

void CoupledStep::advance_grains(GrainState& grains) {
  const PhaseTimer timer(phases_, "grains");
  still_.grains = grains.kin;
  still_.on_grains = grains.fluid;
  Kokkos::parallel_for("grains: still fluid", grains.n, still_);
  move_grains(grains);
  grains_->remove_left(grains);
}

void CoupledStep::move_grains(GrainState& grains) {
  if (frozen_) {
    if (grains.fluid.none) return;
    Kokkos::parallel_for("grains: drag on frozen grains", grains.n,
                         DragOnFrozenGrains{.dt = dt_, .on_grains = grains.fluid});
  } else {
    grains_->advance(grains, n_substeps_, dt_ / n_substeps_);
  }
}

}  // namespace barchan
