#include "src/config/body_keys.hpp"

#include "src/config/key_builder.hpp"

namespace barchan {

void add_bodies(Sections& all) {
  Section& section = all.emplace_back(Section{
      .name = "body",
      .meaning = "Solids at rest in the flow and among the grains, at most eight; each shape takes "
                 "some of the keys",
      .most = kMostBodiesOfCase});
  auto key = repeated_keys(section, [](auto& c) { return &c.bodies; });
  using B = BodyConfig;
  key("name", &B::name, at_most(60), "", "what it is called in tables, files and pictures",
      required_and_fixed);
  key("shape", &B::shape,
      "a fence is a row of upright cylinders; a dune has straight slopes over two half ellipses; "
      "a wave is a floor of sine shape",
      required_and_fixed);
  key("centre", &B::centre, any, "m",
      "[x, z] of its middle; of a dune or a wave that of a crest, where a wave has no z",
      fixed_by_restart);
  key("base", &B::base, between(-1e6, 1e6), "m",
      "of its lowest point above the floor; below 0 it stands deeper", fixed_by_restart);
  key("axis", &B::axis, "direction of a cylinder", fixed_by_restart);
  key("radius", &B::radius, between(0, 1e6), "m",
      "of a cylinder, a sphere, a half sphere, or the posts of a fence", fixed_by_restart);
  key("height", &B::height, between(0, 1e6), "m",
      "of an upright cylinder, a box, a fence, a dune; of a wave from trough to crest",
      fixed_by_restart);
  key("length", &B::length, between(0, 1e6), "m",
      "of a lying cylinder, 0: through the whole domain; of a fence between its outer axes",
      fixed_by_restart);
  key("size", &B::size, between(0, 1e6), "m",
      "[along x, along z] of a box, where 0 is through the whole domain, or a dune",
      fixed_by_restart);
  key("lee", &B::lee, between(0, 1e6), "m",
      "length of a dune's lee side, downstream along x, part of its size", fixed_by_restart);
  key("spacing", &B::spacing, between(0, 1e6), "m", "between the axes of a fence's posts",
      fixed_by_restart);
  key("wavelength", &B::wavelength, between(0, 1e6), "m", "of a wave along x", fixed_by_restart);
  key("angle", &B::angle, between(-7, 7), "rad",
      "by which a box or a fence is turned about its vertical axis, from x towards z",
      fixed_by_restart);
}

}  // namespace barchan
