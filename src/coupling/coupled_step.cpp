#include "src/coupling/coupled_step.hpp"

#include "kernels/coupling/frozen_grains.hpp"
#include "src/grains/clumps.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

/// List rebuilds during its own life are a phase of their own, not time of the grains.
class RebuildSeconds {
 public:
  RebuildSeconds(Phases& phases, const NeighborList& list)
      : phases_(phases), list_(list), before_(list.seconds()) {}
  ~RebuildSeconds() {
    const double seconds = list_.seconds() - before_;
    phases_["grains"] -= seconds;
    phases_["list"] += seconds;
  }
  RebuildSeconds(const RebuildSeconds&) = delete;
  RebuildSeconds& operator=(const RebuildSeconds&) = delete;

 private:
  Phases& phases_;
  const NeighborList& list_;
  double before_;
};

/// Flow around immersed grains fills them, so it has no fraction.
std::unique_ptr<FluidSolver> make_solver(const CoupledCase& config, const Grid& grid) {
  if (config.grains && is_immersed(config.coupling, config.grains->grains))
    return std::make_unique<FluidSolver>(*config.fluid, grid, Fraction::uniform);
  return std::make_unique<FluidSolver>(*config.fluid, grid);
}

}  // namespace

CoupledStep::CoupledStep(const CoupledCase& config, SystemState& state)
    : dt_(config.time.fluid_step), n_substeps_(grain_substeps(config.time)) {
  if (state.fluid) fluid_ = make_solver(config, state.fluid->grid);
  if (!state.grains) return;
  const GrainConfig& grains = config.grains->grains;
  frozen_ = grains.frozen;
  grains_ = std::make_unique<GrainSolver>(*config.grains, *state.grains);
  if (grains.feed) feed_.emplace(*config.grains);
  const auto& g = grains.gravity;
  still_.weight.gravity = {g[0], g[1], g[2]};
  if (state.fluid) {
    add_fluid(*state.grains);
    const CouplingConfig& coupling = config.coupling;
    add_exchange(*state.grains, coupling.forces);
    if (state.grains->clump.size() > 0) add_parts(*state.grains);
    if (coupling.scheme == CouplingScheme::resolved)
      (frozen_ ? add_resolved_forces : add_immersed)(*state.grains);
    if (!is_immersed(coupling, grains))  // whose scheme finds the grains of other ranks
      fluid_side_ =
          FluidSideGrains(state.fluid->grid, is_periodic_x(grains), *state.grains, coupling.forces);
    exchange_ = make_exchange_scheme(config, *fluid_, *state.grains, state.fluid->grid);
    grains_->list().use_scratch(ScratchMemory(fluid_->workspace().of_any_bits()));
  } else if (grains.ambient) {
    add_fluid(*state.grains);
    still_.rho_f = still_.weight.displaced = grains.ambient->density;
    still_.mu_f = still_.rho_f * grains.ambient->kinematic_viscosity;
  }
}

void CoupledStep::start(SystemState& state) {
  if (frozen_) {  // what does not move has no velocity, whatever its file says
    const auto kin = state.grains->kin;
    const auto clump = state.grains->clump;
    Kokkos::parallel_for(
        "grains: freeze", state.grains->n, KOKKOS_LAMBDA(int g) {
          kin(g).u = Vec3{};
          kin(g).omega = Vec3{};
          if (clump.extent(0) > 0) clump(g).u = clump(g).j = Vec3{};
        });
  }
  if (grains_) grains_->start(*state.grains);
  if (exchange_) {
    const auto parts = clumps_.parts(*state.grains);
    exchange_->start(fluid_side_.to_fluid_ranks(*state.grains, kDepositReads), *state.fluid);
  }
  if (!fluid_) return;
  fluid_->fill_ghosts(*state.fluid);
  fluid_->flow_around_bodies(*state.fluid);
}

void CoupledStep::advance(SystemState& state) {
  gather(state);
  move_grains(state);
  deposit(state);
  advance_fluid(state);
  close_step(state);
}

void CoupledStep::gather(SystemState& state) {
  if (!grains_) return;
  GrainState& grains = *state.grains;
  const PhaseTimer timer(phases_, exchange_ ? "exchange" : "grains");
  if (exchange_) {
    const auto parts = clumps_.parts(grains);
    exchange_->gather(*state.fluid, fluid_side_.to_fluid_ranks(grains, kGatherReads), dt_);
    fluid_side_.to_grain_ranks(grains, kGatherWrites);
    ClumpsInFlow::join(grains);
  } else {
    still_.grains = grains.kin;
    still_.on_grains = grains.fluid;
    if (grains.clump.size() > 0) still_.clumps = clumps_of(grains);
    still_.id = grains.id;
    Kokkos::parallel_for("grains: still fluid", items(grains.n), still_);
  }
  if (!grains.fluid.has_fluid) return;
  Kokkos::parallel_for("grains: begin fluid step", items(grains.n),
                       BeginFluidStep{grains.kin, grains.fluid, grains.clump});
}

void CoupledStep::move_grains(SystemState& state, int n) {
  if (!grains_) return;
  GrainState& grains = *state.grains;
  const RebuildSeconds apart(phases_, grains_->list());
  const PhaseTimer timer(phases_, "grains");
  if (!frozen_) {
    grains_->advance(grains, n, dt_ / n_substeps_);
  } else if (grains.fluid.has_fluid) {
    Kokkos::parallel_for("grains: drag on frozen grains", grains.n,
                         DragOnFrozenGrains{.dt = dt_, .on_grains = grains.fluid});
  }
}

void CoupledStep::deposit(SystemState& state) {
  if (!exchange_) return;
  const PhaseTimer timer(phases_, "deposit");
  ClumpsInFlow::split(*state.grains);
  const auto parts = clumps_.parts(*state.grains);
  exchange_->deposit(fluid_side_.to_fluid_ranks(*state.grains, kDepositReads), *state.fluid, dt_);
}

void CoupledStep::advance_fluid(SystemState& state) {
  if (fluid_) {
    const PhaseTimer timer(phases_, "fluid");
    fluid_report_ = fluid_->advance(*state.fluid, exchange_ ? exchange_->on_faces() : nullptr, dt_);
  }
  phases_["fluid"] -= fluid_report_.seconds_pressure;
  phases_["pressure"] += fluid_report_.seconds_pressure;
}

void CoupledStep::close_step(SystemState& state) {
  if (!grains_) return;
  GrainState& grains = *state.grains;
  const RebuildSeconds apart(phases_, grains_->list());
  const PhaseTimer timer(phases_, "grains");
  if (exchange_) {
    exchange_->close(grains, dt_);
    ledger_.close_step(exchange_->ledger(), grains);
  }
  if (feed_) {
    feed_->advance(grains, grains_->list());
  } else {
    grains_->remove_left(grains);
  }
}

Vec3 CoupledStep::impulse_on_grains() const {
  if (!exchange_) return {};
  const ExchangeLedger& step = exchange_->ledger();
  return step.given_to_grains + step.flow_on_grains;
}

}  // namespace barchan
