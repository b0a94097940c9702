// Each force on every grain separately, for output.
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
  const FluidOnGrains on = grains.fluid;
  const auto kin = grains.kin;
  const Real dt = dt_;
  if (!on.none) {
    const auto drag = grain_vector("drag", n), added = grain_vector("added mass", n);
    const auto fluid_force = grains.exchange.fluid_force;
    const bool computed = coupling_ != nullptr;
    const SubmergedWeight weight = computed ? coupling_->weight() : still_.weight;
    Kokkos::parallel_for(
        "output: forces on grains", n, KOKKOS_LAMBDA(int g) {
          const Vec3 inertia = (on.added_mass(g) / dt) * (kin(g).u - on.u_start(g));
          // Of the steady force: what is neither weight nor of the pressure gradient and stress.
          added(g) = on.steady_force(g) - weight(kin(g)) - inertia;
          if (computed) added(g) = added(g) - fluid_force(g);
          drag(g) = (1 / dt) * on.drag_impulse(g);
        });
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
  const FluidOnGrains on = grains.fluid;
  const auto kin = grains.kin;
  const auto contact = grains.contact_force;
  const Real dt = dt_;
  Kokkos::parallel_for(
      "output: resultant force", grains.n, KOKKOS_LAMBDA(int g) {
        total(g) = contact(g) + on.steady_force(g);
        if (on.none) return;
        const Vec3 inertia = (on.added_mass(g) / dt) * (kin(g).u - on.u_start(g));
        total(g) += (1 / dt) * on.drag_impulse(g) - inertia;
      });
  return total;
}

Kokkos::View<Vec3*> CoupledStep::mean_resultant_force(const GrainState& grains) const {
  const FluidOnGrains on = grains.fluid;
  if (on.none) return resultant_force(grains);
  const Kokkos::View<Vec3*> mean = grain_vector("mean resultant", grains.n);
  const auto kin = grains.kin;
  const Real dt = dt_;
  Kokkos::parallel_for(
      "output: mean resultant force", grains.n,
      KOKKOS_LAMBDA(int g) { mean(g) = (kin(g).m / dt) * (kin(g).u - on.u_start(g)); });
  return mean;
}

}  // namespace barchan
