// Kinds of grains: their materials, and the laws of their contacts.
#pragma once

#include <map>
#include <utility>
#include <variant>
#include <vector>

#include "kernels/grains/law_table.hpp"
#include "src/grains/grains_case.hpp"

namespace barchan {

/// Materials of the kinds of grains, at most kMaxKinds. A case has one; GrainState::kind says which
/// each grain is of.
struct GrainKinds {
  std::vector<Material> material;  // of each kind: elastic constants, and contacts within the kind
  std::map<std::pair<int, int>, Material> unlike;  // restitution, friction of (a, b), a < b

  int count() const { return static_cast<int>(material.size()); }
  /// Restitution and friction of a contact. Throws std::out_of_range for an unlike pair that has
  /// none.
  const Material& contact(int a, int b) const {
    if (a == b) return material[static_cast<std::size_t>(a)];
    return unlike.at(std::minmax(a, b));
  }
};

/// Kinds of a case. Values that [[grains.pair]] does not give for a contact of unlike kinds are the
/// geometric mean of both, as in LAMMPS (pair_style granular).
GrainKinds kinds_of(const GrainConfig& config);
/// Densities of the kinds of a case [kg/m^3].
std::vector<Real> densities_of(const GrainConfig& config);

/// Table of laws for several kinds, with one contact model.
template <class Stiffness>
using LawTableOfMany = LawTable<Stiffness, true>;
using LawTables = ContactModels::VariantOf<LawTableOfMany>;

/// Laws of the contacts of all kinds with each other.
LawTables laws_of_pairs(const GrainConfig& config, const GrainKinds& kinds, const Film& film = {});
/// Laws of the contacts of all kinds with the walls, under law_entry(kind, 0).
LawTables laws_of_walls(const GrainConfig& config, const GrainKinds& kinds, const Film& film = {});

/// Table with the first entry alone.
template <class Stiffness>
LawTable<Stiffness, false> only_law(const LawTable<Stiffness, true>& table) {
  return {.stiffness = {table.stiffness[0]}, .friction = {table.friction[0]}};
}

}  // namespace barchan
