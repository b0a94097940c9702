#include "src/coupling/immersed_flow.hpp"

#include "src/parallel/launch.hpp"

namespace barchan {

ImmersedFlow::ImmersedFlow(const CoupledCase& config, FluidSolver& solver, const GrainState& grains,
                           const Grid& grid) {
  const Real density = config.fluid->fluid.density;
  const auto& g = config.grains->grains.gravity;
  weight_ = {.gravity = {g[0], g[1], g[2]}, .displaced = density};
  boundary_ = std::make_shared<ImmersedBoundary>(grid, density, grains.r_max);
  solver.add_term(boundary_, ImmersedBoundary::numbers());
}

void ImmersedFlow::start(const GrainState& grains, FluidState& fluid) {
  Kokkos::deep_copy(fluid.alpha_f.storage, Real(1));
  Kokkos::deep_copy(fluid.alpha_f_previous.storage, Real(1));
  boundary_->place(grains);
  boundary_->start(fluid.u);
}

void ImmersedFlow::gather(const FluidState&, GrainState& grains, Real) {
  Kokkos::parallel_for("immersed: forces on grains", items(grains.n),
                       ActOnGrains{.weight = weight_,
                                   .grains = grains.kin,
                                   .exchange = grains.exchange,
                                   .on_grains = grains.fluid});
}

void ImmersedFlow::deposit(const GrainState& grains, FluidState&, Real) {
  boundary_->place(grains);
}

void ImmersedFlow::close(GrainState& grains, Real dt) {
  Kokkos::parallel_for("immersed: acceleration of grains", items(grains.n),
                       KeepAcceleration{grains.kin, grains.fluid, dt});
  ledger_.flow_on_solid = ledger_.flow_on_grains = dt * boundary_->force_on_grains();
}

}  // namespace barchan
