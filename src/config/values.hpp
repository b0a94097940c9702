// The values that a key can have: read from TOML, checked against their range, written as TOML.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/config/config.hpp"
#include "src/config/toml_tree.hpp"

namespace barchan {

// The names of the choices, in the order of the values of each enum.
using namespace std::string_view_literals;
constexpr auto names_of(Turbulence) { return std::array{"none"sv, "wale"sv}; }
constexpr auto names_of(WallFlow) { return std::array{"no_slip"sv, "free_slip"sv}; }
constexpr auto names_of(CoulombLimit) { return std::array{"total"sv, "elastic"sv}; }
constexpr auto names_of(RollingModel) {
  return std::array{"none"sv, "epsd2"sv, "theta_m"sv, "cdt"sv};
}
constexpr auto names_of(ContactModel) { return std::array{"hertz_mindlin"sv, "linear"sv}; }
constexpr auto names_of(GrainBoundaryX) {
  return std::array{"exit"sv, "periodic"sv, "wall"sv, "follow"sv};
}
constexpr auto names_of(GrainBoundaryZ) { return std::array{"periodic"sv, "wall"sv}; }
constexpr auto names_of(GrainFloor) { return std::array{"smooth"sv, "glued"sv}; }
constexpr auto names_of(PourShape) { return std::array{"cone"sv, "bed"sv}; }
constexpr auto names_of(HeapShape) { return std::array{"cone"sv, "ridge"sv, "bed"sv}; }
constexpr auto names_of(FeedAmount) { return std::array{"given"sv, "as_lost"sv}; }
constexpr auto names_of(BodyShape) {
  return std::array{"cylinder"sv, "sphere"sv, "half_sphere"sv, "box"sv,
                    "fence"sv,    "dune"sv,   "wave"sv};
}
constexpr auto names_of(BodyAxis) { return std::array{"x"sv, "y"sv, "z"sv}; }
constexpr auto names_of(DragLaw) {
  return std::array{"gidaspow"sv, "di_felice"sv,      "koch_hill"sv,        "syamlal_obrien"sv,
                    "beetstra"sv, "paper_repaired"sv, "gidaspow_blended"sv, "none"sv};
}
constexpr auto names_of(VoidFraction) { return std::array{"divided"sv, "centre"sv}; }
constexpr auto names_of(CouplingScheme) {
  return std::array{"layered"sv, "centred"sv, "smoothed"sv, "cfdem"sv};
}
constexpr auto names_of(Preconditioner) { return std::array{"fft"sv, "local_fft"sv}; }

template <class Choice>
inline constexpr auto kChoiceNames = names_of(Choice{});

// A value added at the end of an enum without its name here fails these.
static_assert(kChoiceNames<RollingModel>.size() == std::size_t(RollingModel::cdt) + 1);
static_assert(kChoiceNames<GrainBoundaryX>.size() == std::size_t(GrainBoundaryX::follow) + 1);
static_assert(kChoiceNames<GrainFloor>.size() == std::size_t(GrainFloor::glued) + 1);
static_assert(kChoiceNames<PourShape>.size() == std::size_t(PourShape::bed) + 1);
static_assert(kChoiceNames<HeapShape>.size() == std::size_t(HeapShape::bed) + 1);
static_assert(kChoiceNames<FeedAmount>.size() == std::size_t(FeedAmount::as_lost) + 1);
static_assert(kChoiceNames<BodyShape>.size() == std::size_t(BodyShape::wave) + 1);
static_assert(kChoiceNames<DragLaw>.size() == std::size_t(DragLaw::none) + 1);
static_assert(kChoiceNames<VoidFraction>.size() == std::size_t(VoidFraction::centre) + 1);
static_assert(kChoiceNames<CouplingScheme>.size() == std::size_t(CouplingScheme::cfdem) + 1);
static_assert(kChoiceNames<Preconditioner>.size() == std::size_t(Preconditioner::local_fft) + 1);

/// The members of coupling.forces, by name.
struct ForceName {
  std::string_view name;
  bool ForceSwitches::*on;
};
inline constexpr std::array<ForceName, 8> kForceNames{
    {{"drag", &ForceSwitches::drag},
     {"pressure_gradient", &ForceSwitches::pressure_gradient},
     {"stress", &ForceSwitches::stress},
     {"added_mass", &ForceSwitches::added_mass},
     {"buoyancy", &ForceSwitches::buoyancy},
     {"lift", &ForceSwitches::lift},
     {"torque", &ForceSwitches::torque},
     {"wall_drag", &ForceSwitches::wall_drag}}};

/// What a number may be: each of an array, each diameter of size classes; of a text the bytes. Wide
/// on purpose: what is merely unusual is the user's business, but powers of it must be numbers.
struct Range {
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  double min = -infinite, max = infinite;
  bool above_min = false, below_max = false;  // the bound itself is excluded

  constexpr Range at_most(double bound) const { return {min, bound, above_min, false}; }
  constexpr Range below(double bound) const { return {min, bound, above_min, true}; }
  /// "above 0 and at most 1"; empty if there are no bounds.
  std::string text() const;
};
constexpr Range above(double bound) { return {.min = bound, .above_min = true}; }
constexpr Range at_least(double bound) { return {.min = bound}; }
constexpr Range at_most(double bound) { return {.max = bound}; }
constexpr Range between(double min, double max) { return {min, max}; }
constexpr Range any{};

/// What is given for a T: of an optional, its value.
template <class T>
T plain(const T&);
template <class T>
T plain(const std::optional<T>&);
template <class T>
using Plain = decltype(plain(std::declval<T>()));

/// What a value must be and is not, "a number"; nothing if all is well.
using Mismatch = std::optional<std::string>;

/// From TOML; after a mismatch the value is of no use.
Mismatch convert(const Node& node, double& value);
Mismatch convert(const Node& node, PlaneVelocity& value);
Mismatch convert(const Node& node, bool& value);
Mismatch convert(const Node& node, std::string& value);
Mismatch convert(const Node& node, std::filesystem::path& value);
Mismatch convert(const Node& node, std::vector<SizeClass>& value);
Mismatch convert(const Node& node, ForceSwitches& value);
/// The index of the name that the node holds.
Mismatch convert_name(const Node& node, std::span<const std::string_view> names, std::size_t& at);

template <class T>
requires std::is_integral_v<T> Mismatch convert(const Node& node, T& value) {
  const auto* integer = std::get_if<std::int64_t>(&node.value);
  if (integer == nullptr) return "an integer";
  if (std::is_unsigned_v<T> && *integer < 0) return "an integer, at least 0";
  if (!std::in_range<T>(*integer)) {
    return fmt::format("an integer up to {}", std::numeric_limits<T>::max());
  }
  value = static_cast<T>(*integer);
  return {};
}

template <class Choice>
requires std::is_enum_v<Choice> Mismatch convert(const Node& node, Choice& value) {
  std::size_t at = 0;
  const Mismatch mismatch = convert_name(node, kChoiceNames<Choice>, at);
  value = static_cast<Choice>(at);
  return mismatch;
}

template <class T, std::size_t N>
Mismatch convert(const Node& node, std::array<T, N>& value) {
  const std::string words =
      fmt::format("an array of {} {}s", N, std::is_arithmetic_v<T> ? "number" : "string");
  const auto* elements = std::get_if<NodeArray>(&node.value);
  if (elements == nullptr || elements->size() != N) return words;
  for (std::size_t n = 0; n < N; ++n) {
    if (const Mismatch mismatch = convert((*elements)[n], value[n])) {
      return fmt::format("{}, each {}", words, *mismatch);
    }
  }
  return {};
}

/// As TOML: a string quoted and escaped.
std::string toml_text(std::string_view text);
/// The shortest text that reads back as the same number, always a TOML float ("2.0", "1e-06").
std::string toml_text(double value);
std::string toml_text(const PlaneVelocity& value);
std::string toml_text(const std::vector<SizeClass>& value);
std::string toml_text(const ForceSwitches& value);
/// The names that coupling.forces may hold.
std::string all_forces();
/// As one would write it in a file, cut after 60 characters.
std::string toml_text(const Node& node);

template <class T>
requires std::is_integral_v<T> std::string toml_text(T value) { return fmt::format("{}", value); }

template <class Choice>
requires std::is_enum_v<Choice> std::string toml_text(Choice value) {
  return toml_text(kChoiceNames<Choice>[static_cast<std::size_t>(value)]);
}

template <class T, std::size_t N>
std::string toml_text(const std::array<T, N>& values) {
  std::string text;
  for (const T& value : values) text += (text.empty() ? "" : ", ") + toml_text(value);
  return "[" + text + "]";
}

/// The same; nothing for a value that is not given.
template <class T>
std::optional<std::string> optional_text(const T& value) {
  if constexpr (requires { value.has_value(); }) {
    return value ? optional_text(*value) : std::nullopt;
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return value.empty() ? std::nullopt : std::optional(toml_text(value.string()));
  } else {
    return toml_text(value);
  }
}

/// Within its range?
Mismatch check(double value, const Range& range);
Mismatch check(const std::string& value, const Range& range);

template <class T>
Mismatch check(const T& value, const Range& range) {
  if constexpr (std::is_integral_v<T>) {
    return check(static_cast<double>(value), range);
  } else if constexpr (std::is_same_v<T, SizeClass>) {
    return check(value.diameter, range);
  } else if constexpr (std::is_same_v<T, PlaneVelocity>) {
    return check(std::array{value.x, value.z}, range);
  } else if constexpr (requires { value.data(); }) {
    for (const auto& element : value) {
      if (const Mismatch mismatch = check(element, range)) return mismatch;
    }
  }
  return {};  // a choice, forces; a path: load.cpp looks whether the file is there
}

/// What one writes for it, in words: "number", "array of 3 numbers", or the choices.
template <class T>
std::string type_text() {
  if constexpr (std::is_enum_v<T>) {
    return fmt::format("\"{}\"", fmt::join(kChoiceNames<T>, "\", \""));
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_integral_v<T>) {
    return "integer";
  } else if constexpr (std::is_floating_point_v<T>) {
    return "number";
  } else if constexpr (std::is_same_v<T, PlaneVelocity>) {
    return "number or [x, z]";
  } else if constexpr (std::is_convertible_v<T, std::string>) {  // a path, too
    return "text";
  } else if constexpr (std::is_same_v<T, ForceSwitches>) {
    return "array of " + all_forces();
  } else if constexpr (std::is_same_v<T, std::vector<SizeClass>>) {
    return "array of [diameter, count]";
  } else {
    return fmt::format("array of {} {}s", T{}.size(), type_text<typename T::value_type>());
  }
}

}  // namespace barchan
