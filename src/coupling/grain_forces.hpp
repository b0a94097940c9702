// Forces on the grains over the last fluid step, for output.
#pragma once

#include "src/coupling/system_state.hpp"
#include "src/grains/grain_solver.hpp"

namespace barchan {

/// Forces [N] and the torque of the flow [N m] on every grain, in the order of the state. An empty
/// array: the run has no such force; others have one entry at least, also on a rank without grains.
struct ForceArrays {
  using OfGrains = Kokkos::View<const Vec3*>;
  OfGrains flow = {};    // where it is resolved around the grains, else the next five
  OfGrains torque = {};  // of the flow
  OfGrains drag = {}, added_mass = {}, lift = {}, pressure_gradient = {}, stress = {};
  OfGrains contact = {};  // normal and tangential together
  OfGrains contact_normal = {}, contact_tangential = {};
  OfGrains total = {};  // the resultant with weight and buoyancy
};

/// Forces of the last step, without `contact`. `solver` is the one that moved the grains, dt the
/// length of the fluid step [s].
ForceArrays grain_forces(const SystemState& state, const GrainSolver& solver, Real dt);

/// Kinematics of the entries that the fluid acts on; of a clump that is its first sphere, with the
/// velocity of the whole.
Kokkos::View<const GrainKinematics*> kinematics_in_fluid(const GrainState& grains);

/// Sums over the spheres of each clump, in the order of whole_grains().
ForceArrays of_whole_grains(const GrainState& grains, const ForceArrays& of_spheres);

/// Resultant force on each grain [N].
Kokkos::View<Vec3*> resultant_force(const GrainState& grains, Real dt);

/// Mean resultant over the last fluid step: with a fluid, the change of the grains' momentum over
/// dt; without, the same as resultant_force(). Contacts of one grain step alone would be mostly
/// vibration.
Kokkos::View<Vec3*> mean_resultant_force(const GrainState& grains, Real dt);

}  // namespace barchan
