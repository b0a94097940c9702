// Everything the grains remember from one sub-step to the next.
#pragma once

#include <mpi.h>

#include <cstdint>

#include "kernels/grains/fluid_on_grains.hpp"
#include "kernels/grains/grain_motion.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Grains [0, n) of this rank. Rows are in spatial order, which a list rebuild changes; `id` never
/// changes. Arrays may have room for more rows. Behind the rows of `kin` and `id` stand ghosts,
/// copies of grains of other ranks.
struct GrainState {
  int n = 0, n_ghosts = 0;
  MPI_Comm ranks = MPI_COMM_SELF;                        // that share the grains
  Kokkos::View<GrainKinematics*> kin;                    // position, velocity, spin, radius, mass
  Kokkos::View<std::int64_t*> id;                        // never reused
  Kokkos::View<Vec3*> contact_force, contact_torque;     // at the current positions [N], [N m]
  Kokkos::View<Vec3*> x_reference;                       // positions at the last list rebuild [m]
  FluidOnGrains fluid;                                   // constant over one fluid step
  ExchangeOnGrains exchange;                             // kept for the deposit
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> wall_xi_t;    // (n, wall / 2), see Walls [m]
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> wall_torque;  // the same, rolling torque [N m]; or empty
  Kokkos::View<std::uint8_t*> wall_touching;             // bit per wall
  PairList list;                                         // neighbours and their contact history
  Real r_max = 0, r_min = 0;                             // [m], of the initial grains of all ranks
  Real sauter_diameter = 0;                              // sum d^3 / sum d^2 of the same [m]
  std::int64_t n_initial = 0;                            // grains at t = 0, of all ranks
  std::int64_t n_left = 0;                               // left through the outlet, on this rank
};

/// Rows for n grains of this rank, to be filled.
GrainState make_grain_rows(int n, MPI_Comm ranks);
/// Grains at rest in the list's eyes: no history, no fluid. density [kg/m^3]. Each rank takes an
/// equal share of the rows; the first neighbour list then gives them to those who own the place.
GrainState make_grain_state(const InitialGrains& initial, Real density,
                            MPI_Comm ranks = MPI_COMM_SELF);
/// Arrays of a fluid around the grains; those of the exchange with a flow that is computed.
void add_fluid(GrainState& grains);
void add_exchange(GrainState& grains);

/// Room for n rows in all arrays, some more where it grows; what they hold stays.
void reserve_rows(GrainState& grains, int n);

/// Takes the rows in the order of `row` (new row -> old row) and keeps the first n of them. `room`:
/// as many as there are grains, overwritten.
void permute(GrainState& grains, const Kokkos::View<int*>& row, int n,
             const Kokkos::View<Quad*>& room);

}  // namespace barchan
