// Values of a case with types of their own: velocities along the floor, sizes of grains, forces.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "src/case/config.hpp"
#include "src/toml/form.hpp"

namespace barchan {

/// Member of coupling.forces with its name.
struct ForceName {
  std::string_view name;
  bool ForceSwitches::*on;
};
inline constexpr std::array<ForceName, 9> kForceNames{
    {{"drag", &ForceSwitches::drag},
     {"pressure_gradient", &ForceSwitches::pressure_gradient},
     {"stress", &ForceSwitches::stress},
     {"added_mass", &ForceSwitches::added_mass},
     {"buoyancy", &ForceSwitches::buoyancy},
     {"lift", &ForceSwitches::lift},
     {"torque", &ForceSwitches::torque},
     {"wall_drag", &ForceSwitches::wall_drag},
     {"mixture_viscosity", &ForceSwitches::mixture_viscosity}}};

/// Word for a set of forces.
struct ForceSet {
  std::string_view name;
  ForceSwitches forces;
};
inline constexpr std::array<ForceSet, 2> kForceSets{
    {{"paper", {}},
     {"complete", {.lift = true, .torque = true, .wall_drag = true, .mixture_viscosity = true}}}};

Mismatch convert(const Node& node, PlaneVelocity& value);
Mismatch convert(const Node& node, std::vector<SizeClass>& value);
Mismatch convert(const Node& node, std::vector<ClumpSphere>& value);
Mismatch convert(const Node& node, ForceSwitches& value);

std::string toml_text(const PlaneVelocity& value);
std::string toml_text(const std::vector<SizeClass>& value);
std::string toml_text(const std::vector<ClumpSphere>& value);
std::string toml_text(const ForceSwitches& value);

Mismatch check(const PlaneVelocity& value, const Range& range);
Mismatch check(const SizeClass& value, const Range& range);

template <>
struct ValueKind<PlaneVelocity> {
  static std::string type() { return "number or [x, z]"; }
  static Form form();
};
template <>
struct ValueKind<std::vector<SizeClass>> {
  static std::string type() { return "array of [diameter, count]"; }
  static Form form();
};
template <>
struct ValueKind<std::vector<ClumpSphere>> {
  static std::string type() { return "array of [x, y, z, radius]"; }
  static Form form();
};
template <>
struct ValueKind<ForceSwitches> {
  static std::string type();
  static Form form();
};

}  // namespace barchan
