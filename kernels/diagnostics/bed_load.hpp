// The surface of a bed of grains, and the stress and the load there.
//
// The surface is where the production of fluctuation energy of the grains, P d<v_x>/dy, is
// largest: the effective height at which energetic grains rebound. The load is what lies above it,
// and the stress that drives the transport is that of fluid and grains there.
// Paehtz & Duran, Phys. Rev. Fluids 3, 104302 (2018), arXiv:1609.06005; Paehtz et al.,
// arXiv:2404.07689.
#pragma once

#include "kernels/coupling/grain_rows.hpp"
#include "kernels/fluid/momentum.hpp"

namespace barchan {

/// Calls add(layer, share) for each of n layers of height h [m], from the floor up, that a sphere
/// of radius r [m] at the height y [m] reaches into, with the share of its volume that lies there.
/// The lowest layer has also what lies in the floor, the highest what lies above it.
template <class Add>
KOKKOS_INLINE_FUNCTION void share_among_layers(Real y, Real r, Real h, int n, const Add& add) {
  const auto layer_of = [=](Real at) {
    return static_cast<int>(Kokkos::clamp(Kokkos::floor(at / h), Real(0), Real(n - 1)));
  };
  const int last = layer_of(y + r);
  Real below = 0;
  for (int k = layer_of(y - r); k <= last; ++k) {
    const Real to = k == last ? Real(1) : SphereBelow(((k + 1) * h - y) / r).share;
    add(k, to - below);
    below = to;
  }
}

/// Pressure of the grains [Pa] that carries all of them above, by their vertical momentum in steady
/// transport without suspension:
///   P(y) = g int_y^H (rho_p - rho_f) phi dy,
/// with g the part of gravity towards the floor [m/s^2] and the integral, their mass without that
/// of the fluid in their place [kg/m^2].
KOKKOS_INLINE_FUNCTION Real particle_pressure(Real g, Real submerged_above) {
  return g * submerged_above;
}

/// Production of fluctuation energy of the grains by their mean shear, P d<v_x>/dy [W/m^3].
KOKKOS_INLINE_FUNCTION Real fluctuation_production(Real pressure, Real shear_rate) {
  return pressure * shear_rate;
}

/// What pulls along x on all that lies above a height, fluid and grains, per area of the floor.
struct PullFromAbove {
  Real top = 0;        // stress of the fluid at the top of the box [Pa]; 0 without friction
  Real gradient = 0;   // driving pressure gradient, on fluid and grains [Pa/m]
  Real height = 0;     // of the box above [m]
  Real gravity_x = 0;  // [m/s^2]
  Real submerged = 0;  // mass of the grains above without that of fluid in their place [kg/m^2]
  Real momentum_gained = 0;  // of fluid and grains above, per time [Pa]

  /// Shear stress of fluid and grains together [Pa], by the momentum along x of the column above:
  ///   tau(y) = tau_top + G (H - y) + g_x int_y^H (rho_p - rho_f) phi dy
  ///            - d/dt int_y^H (rho_f alpha u + rho_p phi v) dy.
  KOKKOS_INLINE_FUNCTION Real stress() const {
    return top + gradient * height + gravity_x * submerged - momentum_gained;
  }
};

/// Place of the maximum of a parabola through three equally spaced values of which the middle one
/// is the largest, from there in units of the spacing: within -1/2 and 1/2.
KOKKOS_INLINE_FUNCTION Real peak_offset(Real below, Real middle, Real above) {
  const Real bend = (middle - below) + (middle - above);
  return bend > 0 ? Kokkos::clamp((above - below) / (2 * bend), Real(-0.5), Real(0.5)) : Real(0);
}

/// Scales of transport by weight: grains of diameter d [m], with the density excess [kg/m^3] over a
/// fluid of density rho_f [kg/m^3].
struct TransportScales {
  Real excess = 0, fluid_density = 0, g = 0, d = 0;
  /// (rho_p - rho_f) g d, of the Shields number [Pa].
  KOKKOS_INLINE_FUNCTION Real stress() const { return excess * g * d; }
  /// sqrt((rho_p/rho_f - 1) g d^3), of q* [m^2/s].
  KOKKOS_INLINE_FUNCTION Real flux() const {
    return Kokkos::sqrt(excess / fluid_density * g * d) * d;
  }
};

/// Adds up alpha u_x over each row of cells, a team per row [m/s]; for j = ny the stress along x on
/// the top of the box over the density of the fluid [m^2/s^2].
struct SumRowMomentum {
  GridRef grid;
  ConstFieldRef u_x, alpha;
  StressDivergence stress;
  Kokkos::View<Real*> sums;  // (ny + 1)

  using Team = Kokkos::TeamPolicy<>::member_type;
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const int j = team.league_rank();
    Real row = 0;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, grid.nx * grid.nz),
        [&](int n, Real& part) {
          const int i = n % grid.nx, k = n / grid.nx;
          part += j < grid.ny ? cell_to_xface(alpha, i, j, k) * u_x(i, j, k) : stress.xy(i, j, k);
        },
        row);
    Kokkos::single(Kokkos::PerTeam(team), [&] { sums(j) = row; });
  }
};

}  // namespace barchan
