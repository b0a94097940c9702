// Forces on the grains over the last fluid step, for output.
#pragma once

#include <vector>

#include "src/coupling/system_state.hpp"
#include "src/grains/grain_solver.hpp"

namespace barchan {

/// By name [N], rows as in the state: drag, pressure gradient, stress, added mass, contact normal
/// and tangential, and total, the resultant with weight and buoyancy. Torques of the flow [N m]
/// where it has some. `solver` is the one that
/// moved the grains, dt the length of the fluid step [s].
std::vector<NamedForce> grain_forces(const SystemState& state, const GrainSolver& solver, Real dt);

/// The last of them alone.
Kokkos::View<Vec3*> resultant_force(const GrainState& grains, Real dt);

/// Its mean over the last fluid step, what changed the grains' momentum in water; without, the same
/// as above. Contacts of one grain step alone would be mostly vibration.
Kokkos::View<Vec3*> mean_resultant_force(const GrainState& grains, Real dt);

}  // namespace barchan
