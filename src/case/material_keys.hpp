// Keys of materials: of the grains, the walls, kinds of grains and pairs of kinds.
#pragma once

#include "src/grains/grains_case.hpp"
#include "src/toml/key_builder.hpp"

namespace barchan {

/// Adds the keys of a material, to [grains] and to each section with a material of its own. `get`
/// as in Keys.
template <class Get>
void add_material(Section& section, Get get) {
  Keys key(section, get);
  using M = Material;
  key("youngs_modulus", &M::youngs_modulus, between(1e-3, 1e30), "Pa", "Young's modulus");
  key("poisson_ratio", &M::poisson_ratio, between(0, 0.5), "", "Poisson's ratio");
  key("restitution", &M::restitution, above(0).at_most(1), "", "coefficient of restitution");
  key("sliding_friction", &M::sliding_friction, between(0, 1e6), "",
      "coefficient of sliding friction");
  key("rolling_friction", &M::rolling_friction, between(0, 1e6), "",
      "coefficient of rolling friction");
}

/// Adds the keys of a shape, to [grains] and [[grains.kind]].
template <class Get>
void add_shape(Section& section, Get get) {
  Keys key(section, get);
  using S = ShapeConfig;
  key("shape", &S::shape,
      "spheres, or rigid clumps of spheres; the diameter of a clump is that of the sphere of its "
      "volume",
      fixed_by_restart);
  key("spheres", &S::spheres,
      "spheres of a clump, at most 64, in any unit of length. They may overlap: volume, mass and "
      "inertia are those of their union. Contacts count sphere by sphere: where several overlap, a "
      "contact is stiffer and its restitution lower",
      fixed_by_restart);
  key("clump", &S::clump,
      "a clump with a name: two overlapping spheres, four or eight that touch, or an angular grain "
      "like sand",
      fixed_by_restart);
}

/// Adds [grains.wall], [[grains.kind]], [[grains.pair]].
void add_wall(Sections& all);
void add_kinds(Sections& all);
void add_pairs(Sections& all);

}  // namespace barchan
