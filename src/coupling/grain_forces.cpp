#include "src/coupling/grain_forces.hpp"

#include <algorithm>
#include <string>

#include "kernels/coupling/force_output.hpp"
#include "src/grains/clumps.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

Kokkos::View<Vec3*> grain_vector(const std::string& name, int n) {
  return Kokkos::View<Vec3*>(name, static_cast<std::size_t>(std::max(n, 1)));
}

}  // namespace

ForceArrays grain_forces(const SystemState& state, const GrainSolver& solver, Real dt) {
  const GrainState& grains = *state.grains;
  const int n = grains.n;
  ForceArrays forces;
  const bool resolved = grains.exchange.resolved_force.size() > 0;
  if (resolved) {
    forces.flow = grains.exchange.resolved_force;
    forces.torque = grains.exchange.resolved_torque;
  } else if (grains.fluid.has_fluid) {
    const auto drag = grain_vector("drag", n), added = grain_vector("added mass", n);
    Kokkos::parallel_for("output: forces on grains", items(n),
                         DragAndAddedMass{.grains = kinematics_in_fluid(grains),
                                          .on_grains = grains.fluid,
                                          .exchange = grains.exchange,
                                          .dt = dt,
                                          .drag = drag,
                                          .added_mass = added});
    forces.drag = drag;
    forces.added_mass = added;
  }
  forces.lift = grains.exchange.lift;
  if (state.fluid && !resolved) {
    forces.pressure_gradient = grains.exchange.pressure_force;
    forces.stress = grains.exchange.stress_force;
  }
  if (grains.fluid.has_torque && !resolved) {
    const auto torque = grain_vector("torque of the flow", n);
    Kokkos::parallel_for("output: torques on grains", items(n),
                         TorqueOfFlow{grains.kin, grains.fluid, torque});
    forces.torque = torque;
  }
  const auto normal = grain_vector("contact normal", n), tangential = grain_vector("tangential", n);
  solver.split_contacts(grains, normal, tangential);
  forces.contact_normal = normal;
  forces.contact_tangential = tangential;
  forces.total = resultant_force(grains, dt);
  return forces;
}

Kokkos::View<const GrainKinematics*> kinematics_in_fluid(const GrainState& grains) {
  if (grains.clump.size() == 0) return grains.kin;
  const Kokkos::View<GrainKinematics*> moved("kinematics of clumps", grains.kin.extent(0));
  const auto kin = grains.kin;
  const auto clump = grains.clump;
  Kokkos::parallel_for(
      "clumps: velocities in the fluid", items(grains.n), KOKKOS_LAMBDA(int g) {
        moved(g) = kin(g);
        moved(g).u = clump(g).u;
      });
  return moved;
}

ForceArrays of_whole_grains(const GrainState& grains, const ForceArrays& of_spheres) {
  using F = ForceArrays;
  F whole = of_spheres;
  for (auto F::*force :
       {&F::flow, &F::torque, &F::drag, &F::added_mass, &F::lift, &F::pressure_gradient, &F::stress,
        &F::contact, &F::contact_normal, &F::contact_tangential, &F::total})
    whole.*force = sum_over_spheres(grains, of_spheres.*force);
  return whole;
}

Kokkos::View<Vec3*> resultant_force(const GrainState& grains, Real dt) {
  const Kokkos::View<Vec3*> total = grain_vector("total", grains.n);
  Kokkos::parallel_for("output: resultant force", items(grains.n),
                       ResultantForce{.on_grains = grains.fluid,
                                      .contact_force = grains.contact_force,
                                      .dt = dt,
                                      .total = total});
  return total;
}

Kokkos::View<Vec3*> mean_resultant_force(const GrainState& grains, Real dt) {
  const GrainState whole = whole_grains(grains);
  if (!grains.fluid.has_fluid) return resultant_force(whole, dt);
  const Kokkos::View<Vec3*> mean = grain_vector("mean resultant", whole.n);
  Kokkos::parallel_for(
      "output: mean resultant force", items(whole.n),
      MeanResultantForce{
          .grains = whole.kin, .u_start = whole.fluid.u_start, .dt = dt, .mean = mean});
  return mean;
}

}  // namespace barchan
