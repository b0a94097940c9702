#include "src/case/body_keys.hpp"

#include "src/case/case_values.hpp"
#include "src/toml/key_builder.hpp"

namespace barchan {

void add_bodies(Sections& all) {
  Section& section = all.emplace_back(Section{
      .name = "body",
      .meaning = "Solids at rest in the flow and among the grains, at most eight; each shape takes "
                 "some of the keys",
      .most = kMostBodies});
  auto key = repeated_keys(section, [](auto& c) { return &c.bodies; });
  using B = BodyConfig;
  key("name", &B::name, at_most(60), "", "name in tables, files and pictures", required_and_fixed);
  key("shape", &B::shape, "form of the body", required_and_fixed);
  key("centre", &B::centre, any, "m",
      "[x, z] of the middle; of a dune or a wave: of a crest (a wave has no z)", fixed_by_restart);
  key("base", &B::base, between(-1e6, 1e6), "m",
      "height of the lowest point above the floor; negative: buried", fixed_by_restart);
  key("axis", &B::axis, "direction of a cylinder", fixed_by_restart);
  key("radius", &B::radius, between(0, 1e6), "m",
      "radius of a cylinder, a sphere, a half sphere, or the posts of a fence", fixed_by_restart);
  key("height", &B::height, between(0, 1e6), "m",
      "height of an upright cylinder, a box, a fence, a dune; of a wave from trough to crest",
      fixed_by_restart);
  key("length", &B::length, between(0, 1e6), "m",
      "length of a lying cylinder, 0: through the whole domain; of a fence between the outer axes",
      fixed_by_restart);
  key("size", &B::size, between(0, 1e6), "m",
      "[along x, along z] of a box (0: through the whole domain) or a dune", fixed_by_restart);
  key("lee", &B::lee, between(0, 1e6), "m",
      "length of the lee side of a dune, downstream along x, part of `size`", fixed_by_restart);
  key("spacing", &B::spacing, between(0, 1e6), "m",
      "distance between the axes of the posts of a fence", fixed_by_restart);
  key("wavelength", &B::wavelength, between(0, 1e6), "m", "wavelength of a wave along x",
      fixed_by_restart);
  key("angle", &B::angle, between(-7, 7), "rad",
      "rotation of a box or a fence about its vertical axis, from x towards z", fixed_by_restart);
}

}  // namespace barchan
