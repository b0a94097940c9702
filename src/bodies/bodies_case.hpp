// Solids at rest in a case.
#pragma once

#include <array>
#include <string>

#include "kernels/bodies/body.hpp"

namespace barchan {

using BodyShape = Choice<BodyShapes>;

/// [[body]]: a solid at rest in the flow and among the grains. Which keys a shape takes it says
/// itself. Lengths of 0 are not given.
struct BodyConfig {
  std::string name;                // in tables and pictures, required
  BodyShape shape;                 // required
  std::array<double, 2> centre{};  // x, z of its middle; of a dune of its crest [m]
  double base = 0;                 // of its underside above the floor [m]
  Axis axis = Axis::y;             // of a cylinder
  double radius = 0;               // of a cylinder, a sphere, a fence's posts [m]
  double height = 0;               // [m]; of a wave from trough to crest
  double length = 0;               // of a lying cylinder; of a fence between end posts [m]
  std::array<double, 2> size{};    // of a box, a dune: along x, along z [m]
  double lee = 0;                  // length of a dune's lee side, of all its length [m]
  double spacing = 0;              // of a fence's posts, between their axes [m]
  double wavelength = 0;           // [m]
  double angle = 0;                // by which box and fence are turned from x to z [rad]
  bool operator==(const BodyConfig&) const = default;
};

}  // namespace barchan
