#include "src/grains/grain_kinds.hpp"

#include <cmath>
#include <stdexcept>

#include "src/grains/kinds.hpp"

namespace barchan {

namespace {

/// `radius`: of a grain over the effective one, 2 between equal grains, 1 at a wall.
ContactMaterial contact_material(const GrainConfig& config, const Film& film, Real radius,
                                 const Material& a, const Material& b, const Material& contact) {
  return {.a = {.youngs_modulus = a.youngs_modulus, .poisson_ratio = a.poisson_ratio},
          .b = {.youngs_modulus = b.youngs_modulus, .poisson_ratio = b.poisson_ratio},
          .restitution = contact.restitution,
          .linear_stiffness = config.linear_stiffness,
          .tangential_damping = config.tangential_damping,
          .film_viscosity = film.viscosity,
          .film_reach = film.reach,
          .thinnest_film = config.thinnest_film * radius};
}

Friction friction_of(const Material& m, CoulombLimit limit) {
  return {.sliding = m.sliding_friction,
          .rolling = m.rolling_friction,
          .dashpot_in_limit = limit == CoulombLimit::total ? 1.0 : 0.0};
}

/// Calls fill(table) with an empty table of the case's contact model.
template <class Fill>
LawTables filled(const GrainConfig& config, const GrainKinds& kinds, const Fill& fill) {
  if (kinds.count() > kMaxKinds) throw std::length_error("more kinds of grains than kMaxKinds");
  LawTables tables;
  ContactModels::with(config.contact_model,
                      [&]<class Stiffness>() { tables = LawTable<Stiffness, true>{}; });
  std::visit(fill, tables);
  return tables;
}

/// Mixes restitution and friction of two materials where a case gives none; elastic constants are
/// those of each side.
Material mixed(const Material& a, const Material& b) {
  Material m;
  for (auto Material::*member :
       {&Material::restitution, &Material::sliding_friction, &Material::rolling_friction})
    m.*member = std::sqrt(a.*member * b.*member);
  return m;
}

}  // namespace

GrainKinds kinds_of(const GrainConfig& config) {
  GrainKinds kinds;
  for (const KindConfig& kind : all_kinds(config)) kinds.material.push_back(kind.material);
  for (int b = 0; b < kinds.count(); ++b)
    for (int a = 0; a < b; ++a)
      kinds.unlike[{a, b}] = mixed(kinds.contact(a, a), kinds.contact(b, b));
  for (const PairConfig& pair : config.pairs) {
    const int a = kind_of_name(config, pair.kinds[0]), b = kind_of_name(config, pair.kinds[1]);
    Material& m = kinds.unlike.at(std::minmax(a, b));
    m.restitution = pair.restitution.value_or(m.restitution);
    m.sliding_friction = pair.sliding_friction.value_or(m.sliding_friction);
    m.rolling_friction = pair.rolling_friction.value_or(m.rolling_friction);
  }
  return kinds;
}

std::vector<Real> densities_of(const GrainConfig& config) {
  std::vector<Real> densities;
  for (const KindConfig& kind : all_kinds(config)) densities.push_back(kind.density);
  return densities;
}

LawTables laws_of_pairs(const GrainConfig& config, const GrainKinds& kinds, const Film& film) {
  return filled(config, kinds, [&]<class Stiffness>(LawTable<Stiffness, true>& table) {
    for (int a = 0; a < kinds.count(); ++a) {
      for (int b = 0; b < kinds.count(); ++b) {
        const Material& contact = kinds.contact(a, b);
        table.stiffness[law_entry(a, b)] = Stiffness::from(
            contact_material(config, film, 2, kinds.contact(a, a), kinds.contact(b, b), contact));
        table.friction[law_entry(a, b)] = friction_of(contact, config.coulomb_limit);
      }
    }
  });
}

LawTables laws_of_walls(const GrainConfig& config, const GrainKinds& kinds, const Film& film) {
  return filled(config, kinds, [&]<class Stiffness>(LawTable<Stiffness, true>& table) {
    for (int a = 0; a < kinds.count(); ++a) {
      table.stiffness[law_entry(a, 0)] = Stiffness::from(
          contact_material(config, film, 1, kinds.contact(a, a), config.wall, config.wall));
      table.friction[law_entry(a, 0)] = friction_of(config.wall, config.coulomb_limit);
    }
  });
}

}  // namespace barchan
