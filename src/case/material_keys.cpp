#include "src/case/material_keys.hpp"

#include <algorithm>

#include "src/case/case_values.hpp"

namespace barchan {

void add_wall(Sections& all) {
  Section& section = all.emplace_back(
      Section{.name = "grains.wall",
              .meaning = "Material of the walls; what is not given is as in `[grains]`",
              .like = "grains",
              .prepare = [](Config& c, bool) {
                if (c.grains) c.grains->wall = c.grains->material;
              }});
  add_material(section, [](auto& c) { return c.grains ? &c.grains->wall : nullptr; });
}

void add_kinds(Sections& all) {
  Section& section = all.emplace_back(
      Section{.name = "grains.kind",
              .meaning = "Grains of several kinds, at most four; what a kind leaves out is as in "
                         "`[grains]`",
              .like = "grains",
              .most = kMaxKinds});
  const auto list = [](auto& c) { return c.grains ? &c.grains->kinds : nullptr; };
  auto key = repeated_keys(section, list);
  using K = KindConfig;
  key("name", &K::name, at_most(30), "", "name in tables, files and pictures", required_and_fixed);
  key("density", &K::density, between(1e-6, 1e9), "kg/m3", "density of the grains",
      fixed_by_restart);
  add_material(section, [list](auto& c, std::size_t entry) {
    auto* kinds = list(c);
    return kinds != nullptr && entry < kinds->size() ? &(*kinds)[entry].material : nullptr;
  });
  add_shape(section, [list](auto& c, std::size_t entry) {
    auto* kinds = list(c);
    return kinds != nullptr && entry < kinds->size() ? &(*kinds)[entry].shape : nullptr;
  });
  for (const char* name : {"shape", "spheres", "clump"})  // not those of [grains]
    std::ranges::find(section.keys, name, &Key::name)->by_default =
        name == std::string_view("shape") ? "sphere" : kNoDefault;
  key("sizes", &K::sizes, between(1e-9, 1e6), "m",
      "[[diameter, count], ...] of the grains of this kind to pour");
  section.append = [](Config& c) {
    if (!c.grains) return;
    const GrainConfig& grains = *c.grains;
    c.grains->kinds.push_back({.name = {},
                               .density = grains.density,
                               .material = grains.material,
                               .sizes = grains.sizes});
  };
}

void add_pairs(Sections& all) {
  Section& section = all.emplace_back(
      Section{.name = "grains.pair",
              .meaning = "Contacts of two kinds with each other; what is not given is the "
                         "geometric mean of both kinds",
              .most = kMaxKinds * (kMaxKinds - 1) / 2});
  auto key = repeated_keys(section, [](auto& c) { return c.grains ? &c.grains->pairs : nullptr; });
  using P = PairConfig;
  key("kinds", &P::kinds, "names of the two kinds", required);
  key("restitution", &P::restitution, above(0).at_most(1), "", "coefficient of restitution");
  key("sliding_friction", &P::sliding_friction, between(0, 1e6), "",
      "coefficient of sliding friction");
  key("rolling_friction", &P::rolling_friction, between(0, 1e6), "",
      "coefficient of rolling friction");
}

}  // namespace barchan
