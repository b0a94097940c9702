// Clumps in the entries of a rank: which entries belong together, and the order of spheres whose
// columns belong to other ranks.
#pragma once

#include <string>

#include "kernels/grains/search_columns.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// Checks that each sphere has come with the motion of its clump, as as_spheres() gives it; throws
/// std::logic_error otherwise.
void check_motions(const GrainState& grains);

/// Finds the entries of each clump of this rank from their ids (grains.members). `room`: at least
/// two for each entry. Throws StateError if a clump has not all of its spheres here.
void find_members(GrainState& grains, const Kokkos::View<std::uint64_t*>& room);

/// Number of clumps among the entries whose keys say that they leave.
int clumps_in(const GrainState& grains, const Kokkos::View<const std::uint64_t*>& key);

/// Owned entries and ghosts in the order of their columns and heights.
struct OrderOfPlaces {
  Kokkos::View<GrainKinematics*> grains;
  Kokkos::View<int*> entry = {};  // of each place; empty: they are the same
};
/// Finds an order that all ranks agree on: equal keys come in the order of the ids. `room`: at
/// least one for each entry.
void find_order(const GrainState& grains, const SearchColumns& columns,
                const Kokkos::View<std::uint64_t*>& room, OrderOfPlaces& order);

/// Longest way from the centre of a clump to that of a sphere of it, and the key that says so.
struct LongestArm {
  Real length = 0;
  std::string key{};
};
/// Columns that an arm [m] may cross. Throws InputError beyond kMostArms.
int columns_of_arm(const LongestArm& arm, const SearchColumns& columns);

}  // namespace barchan
