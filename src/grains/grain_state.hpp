// State of the grains from one grain step to the next.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/grains/clump.hpp"
#include "kernels/grains/fluid_on_grains.hpp"
#include "kernels/grains/pair_list.hpp"
#include "src/grains/feed_state.hpp"
#include "src/grains/grains_case.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Condition under which an array of a grain is allocated.
enum class Allocated {
  always,
  with_fluid,
  with_flow,
  with_lift,
  with_torque,
  when_resolved,
  when_immersed,
  by_solver
};

/// Uses of an array of a grain. Every array is also sorted with its grain and goes with it to
/// another rank.
enum GrainUse : unsigned {
  kRestart = 1,          // in restart files
  kRestartWithFlow = 2,  // in restart files of runs that compute the flow
  kGhosts = 4,           // copied to the ghosts when these are found
  kGatherReads = 8,      // sent to the fluid ranks before the gather,
  kGatherWrites = 16,    // and brought back after it
  kDepositReads = 32,    // sent to the fluid ranks before the deposit
  kFluidSide = kGatherReads | kGatherWrites | kDepositReads,
};

/// An array of a grain: its name (also in restart files), unit and uses.
struct GrainArray {
  std::string_view name, unit;
  Allocated allocated;
  unsigned uses;  // uses, as in GrainUse
};
/// Number of each grain beside those that the model needs.
struct ExtraGrainArray {
  std::string name, unit;
  unsigned uses;
  Kokkos::View<Real*> values;
};

/// Value in GrainState::heap of a grain that came from no heap: it was fed.
inline constexpr std::uint8_t kNoHeap = 255;

/// Grains [0, n) of this rank, spheres or spheres of clumps. Entries are in spatial order, which a
/// list rebuild changes; `id` never changes. Arrays may have room for more entries. Behind the
/// entries of `kin` and `id` stand ghosts, copies of grains of other ranks.
struct GrainState {
  int n = 0, n_ghosts = 0;
  MPI_Comm ranks = MPI_COMM_SELF;                      // ranks that share the grains
  Kokkos::View<GrainKinematics*> kin;                  // position, velocity, spin, radius, mass
  Kokkos::View<std::int64_t*> id;                      // never reused
  Kokkos::View<std::uint8_t*> kind;                    // index of the material; empty: one kind
  std::vector<std::string> kind_names;                 // by index, or empty
  Kokkos::View<std::uint8_t*> heap;                    // heap of origin; empty: one heap
  std::vector<std::string> heap_names;                 // by index, or empty
  Kokkos::View<ClumpMotion*> clump;                    // of each entry; empty: spheres alone
  ClumpMembers members;                                // of the clumps, since the last rebuild
  ClumpShapes shapes;                                  // of the kinds, where there are clumps
  Kokkos::View<Vec3*> contact_force, contact_torque;   // at the current positions [N], [N m]
  Kokkos::View<Vec3*> x_reference;                     // positions at the last list rebuild [m]
  FluidOnGrains fluid;                                 // constant over one fluid step
  ExchangeOnGrains exchange;                           // kept for the deposit
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> wall_xi_t;  // (n, history), see Walls [m]
  // rolling torque (n, history) [N m]; or empty
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> wall_torque;
  Kokkos::View<std::uint8_t*> wall_touching;             // bit per wall
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> body_xi_t;    // (n, body) [m]; or empty
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> body_torque;  // rolling torque (n, body) [N m]; or empty
  Kokkos::View<std::uint8_t*> body_touching;             // bit per body; or empty
  std::vector<ExtraGrainArray> extra;                    // see add_extra()
  PairList list;                                         // neighbours and their contact history
  Real r_max = 0, r_min = 0;                             // [m], of the initial spheres of all ranks
  Real sauter_diameter = 0;    // sum d^3 / sum d^2 of the initial grains [m]
  std::int64_t n_initial = 0;  // grains at t = 0, of all ranks
  std::int64_t last_id = 0;    // largest id before any were fed
  std::int64_t n_left = 0;     // left through the outlet, on this rank
  FeedState feed;              // grains that come in
  // Place where the ends of a window that follows its dune meet [m]; not a number: not placed yet.
  Real window_edge = Kokkos::Experimental::quiet_NaN_v<Real>;
};

/// Number of grains of this rank: a clump counts as one.
inline int grain_count(const GrainState& grains) {
  return grains.clump.size() > 0 ? grains.members.n : grains.n;
}

/// Number of the grain of an entry, from its id.
inline std::int64_t grain_number(const GrainState& grains, std::int64_t id) {
  return grains.clump.size() > 0 ? clump_of_id(id) : id;
}

/// Largest number that a grain has or had.
inline std::int64_t last_id(const GrainState& grains) {
  return std::max(grains.last_id, grains.feed.next_id - 1);
}

/// Makes entries for n grains of this rank, to be filled.
GrainState make_grain_entries(int n, MPI_Comm ranks);
/// Makes grains without contact history and fluid, of these densities by kind [kg/m^3]. Each rank
/// takes an equal share of the entries; the first neighbour list then gives them to the ranks that
/// own their columns.
GrainState make_grain_state(const InitialGrains& initial, std::span<const Real> density,
                            MPI_Comm ranks = MPI_COMM_SELF);
/// Makes grains of one density.
GrainState make_grain_state(const InitialGrains& initial, Real density,
                            MPI_Comm ranks = MPI_COMM_SELF);
/// Adds the heap that each grain came from, the first until it is filled in.
void add_heaps(GrainState& grains, const std::vector<std::string>& names);
/// Adds the arrays of a fluid around the grains; the second function, those of the exchange with a
/// computed flow.
void add_fluid(GrainState& grains);
void add_exchange(GrainState& grains, const ForceSwitches& forces = {});
/// Adds the parts that clumps are in a flow.
void add_parts(GrainState& grains);
/// Adds the arrays of forces of a flow that is resolved around the grains.
void add_resolved_forces(GrainState& grains);
/// The same for grains that move in it.
void add_immersed(GrainState& grains);
/// Adds an array of one number for each grain, zero at first; `uses` as in GrainUse.
Kokkos::View<Real*> add_extra(GrainState& grains, const std::string& name, const std::string& unit,
                              unsigned uses);

/// Makes room for n entries in the arrays that have one of the uses, an eighth more where it grows;
/// their content stays.
inline constexpr unsigned kAnyUse = ~0u;
void reserve_entries(GrainState& grains, int n, unsigned uses = kAnyUse);

/// Takes the entries in the order of `entry` (new entry -> old entry) and keeps the first n of
/// them. `room`: as many as there are grains, overwritten.
void permute(GrainState& grains, const Kokkos::View<int*>& entry, int n,
             const Kokkos::View<Vec4*>& room);

}  // namespace barchan
