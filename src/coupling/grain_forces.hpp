// Forces on the grains over the last fluid step, for output.
#pragma once

#include <vector>

#include "src/coupling/system_state.hpp"
#include "src/grains/grain_solver.hpp"

namespace barchan {

/// Forces by name [N], rows as in the state: drag, pressure gradient, stress, added mass, contact
/// normal and tangential, and total, the resultant with weight and buoyancy. Torques of the flow [N
/// m] where it has some. `solver` is the one that moved the grains, dt the length of the fluid step
/// [s].
std::vector<NamedForce> grain_forces(const SystemState& state, const GrainSolver& solver, Real dt);

/// Resultant force on each grain [N].
Kokkos::View<Vec3*> resultant_force(const GrainState& grains, Real dt);

/// Mean resultant over the last fluid step: with a fluid, the change of the grains' momentum over
/// dt; without, the same as resultant_force(). Contacts of one grain step alone would be mostly
/// vibration.
Kokkos::View<Vec3*> mean_resultant_force(const GrainState& grains, Real dt);

}  // namespace barchan
