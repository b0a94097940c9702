// Drag on grains that do not move. Equations: docs/theory-coupling.md, "Coupled step".
#pragma once

#include "kernels/grains/half_kick.hpp"

namespace barchan {

/// Impulse of a whole fluid step on a grain that does not move: one half kick with an infinite
/// mass, so that only the grain's share of fluid moves.
struct DragOnFrozenGrains {
  Real dt = 0;
  FluidOnGrains on_grains;
  KOKKOS_FUNCTION void operator()(int g) const {
    const Real infinity = Kokkos::Experimental::infinity_v<Real>;
    const HalfKick half_kick(dt, {.mass = infinity,
                                  .inertia_moment = infinity,
                                  .inv_fluid_mass = on_grains.inv_fluid_mass(g),
                                  .beta = on_grains.beta(g),
                                  .added_mass = on_grains.added_mass(g)});
    GrainForces f;
    f.u_f = on_grains.u_f_after(0, g), f.acceleration = on_grains.acceleration(g);
    Vec3 u, spin;
    on_grains.impulse(g) = half_kick(f, u, spin);
  }
};

}  // namespace barchan
