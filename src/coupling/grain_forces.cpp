// Each force on every grain separately, for output.
#include "kernels/coupling/gather.hpp"
#include "src/coupling/coupled_step.hpp"

namespace barchan {

namespace {

Kokkos::View<Vec3*> grain_vector(const char* name, int n) {
  return Kokkos::View<Vec3*>(name, static_cast<std::size_t>(n));
}

}  // namespace

/// Evaluated where the flow is.
Kokkos::View<Vec3*> CoupledStep::fluid_force_now(const char* name, const FluidForces& which,
                                                 const SystemState& state) {
  const GrainState& there = fluid_side_.to_fluid_ranks(*state.grains, kForceReads);
  const Kokkos::View<Vec3*> force = grain_vector(name, there.n);
  coupling_->single_force(which, *state.fluid, there, force);
  return fluid_side_.to_grain_ranks(force, state.grains->n);
}

std::vector<NamedForce> CoupledStep::grain_forces(const SystemState& state) {
  const GrainState& grains = *state.grains;
  const int n = grains.n;
  std::vector<NamedForce> forces;
  if (!grains.fluid.none) {
    const auto drag = grain_vector("drag", n), added = grain_vector("added mass", n);
    Kokkos::parallel_for("output: forces on grains", n,
                         DragAndAddedMass{.grains = grains.kin,
                                          .on_grains = grains.fluid,
                                          .weight = coupling_ ? coupling_->weight() : still_.weight,
                                          .fluid_force = grains.exchange.fluid_force,
                                          .dt = dt_,
                                          .drag = drag,
                                          .added_mass = added});
    forces.push_back({"force_drag", drag});
    forces.push_back({"force_added_mass", added});
  }
  if (coupling_) {
    forces.push_back(
        {"force_pressure_gradient", fluid_force_now("pressure gradient", {0, 1, 0, 0, 0}, state)});
    forces.push_back({"force_stress", fluid_force_now("stress", {0, 0, 1, 0, 0}, state)});
  }
  const auto normal = grain_vector("contact normal", n), tangential = grain_vector("tangential", n);
  grains_->split_contacts(grains, normal, tangential);
  forces.push_back({"force_contact_normal", normal});
  forces.push_back({"force_contact_tangential", tangential});
  forces.push_back({"force_total", resultant_force(grains)});
  return forces;
}

Kokkos::View<Vec3*> CoupledStep::resultant_force(const GrainState& grains) const {
  const Kokkos::View<Vec3*> total = grain_vector("total", grains.n);
  Kokkos::parallel_for("output: resultant force", grains.n,
                       ResultantForce{.grains = grains.kin,
                                      .on_grains = grains.fluid,
                                      .contact_force = grains.contact_force,
                                      .dt = dt_,
                                      .total = total});
  return total;
}

Kokkos::View<Vec3*> CoupledStep::mean_resultant_force(const GrainState& grains) const {
  if (grains.fluid.none) return resultant_force(grains);
  const Kokkos::View<Vec3*> mean = grain_vector("mean resultant", grains.n);
  Kokkos::parallel_for(
      "output: mean resultant force", grains.n,
      MeanResultantForce{
          .grains = grains.kin, .u_start = grains.fluid.u_start, .dt = dt_, .mean = mean});
  return mean;
}

}  // namespace barchan
