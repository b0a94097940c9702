// Solids at rest in a case.
#pragma once

#include <array>
#include <string>

#include "kernels/bodies/body.hpp"

namespace barchan {

using BodyShape = Choice<BodyShapes>;

/// [[body]]: a solid at rest in the flow and among the grains. Each shape says which keys it takes.
/// A length of 0 is not given.
struct BodyConfig {
  std::string name;                // in tables and pictures, required
  BodyShape shape;                 // required
  std::array<double, 2> centre{};  // x, z of its middle, or of a dune's crest [m]
  double base = 0;                 // height of its underside above the floor [m]
  Axis axis = Axis::y;             // of a cylinder
  double radius = 0;               // of a cylinder, a sphere, a fence's posts [m]
  double height = 0;               // [m]; of a wave from trough to crest
  double length = 0;               // of a lying cylinder; of a fence between end posts [m]
  std::array<double, 2> size{};    // box, dune: lengths along x, along z [m]
  double lee = 0;                  // dune: length of the lee side, part of its whole length [m]
  double spacing = 0;              // fence: distance between the axes of its posts [m]
  double wavelength = 0;           // [m]
  double angle = 0;                // angle by which box and fence are turned from x to z [rad]
  bool operator==(const BodyConfig&) const = default;
};

}  // namespace barchan
