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
namespace detail {

template <class... Names>
constexpr auto list(Names... names) {
  return std::array<std::string_view, sizeof...(names)>{names...};
}

constexpr auto names_of(Turbulence) { return list("none", "wale"); }
constexpr auto names_of(WallFlow) { return list("no_slip", "free_slip"); }
constexpr auto names_of(CoulombLimit) { return list("total", "elastic"); }
constexpr auto names_of(RollingModel) { return list("none", "epsd2", "theta_m", "cdt"); }
constexpr auto names_of(ContactModel) { return list("hertz_mindlin", "linear"); }
constexpr auto names_of(GrainBoundaryX) { return list("exit", "periodic", "wall"); }
constexpr auto names_of(GrainBoundaryZ) { return list("periodic", "wall"); }
constexpr auto names_of(DragLaw) {
  return list("gidaspow", "di_felice", "koch_hill", "syamlal_obrien", "beetstra", "paper_repaired",
              "none");
}
constexpr auto names_of(Exchange) { return list("by_row", "interpolated", "smoothed"); }
constexpr auto names_of(VoidFraction) { return list("divided", "cfdem_faithful", "centre"); }
constexpr auto names_of(Preconditioner) { return list("fft", "local_fft"); }

}  // namespace detail

template <class Choice>
inline constexpr auto choice_names = detail::names_of(Choice{});

// A value added at the end of an enum without its name here fails these.
static_assert(choice_names<RollingModel>.size() == std::size_t(RollingModel::cdt) + 1);
static_assert(choice_names<GrainBoundaryX>.size() == std::size_t(GrainBoundaryX::wall) + 1);
static_assert(choice_names<DragLaw>.size() == std::size_t(DragLaw::none) + 1);
static_assert(choice_names<Exchange>.size() == std::size_t(Exchange::smoothed) + 1);
static_assert(choice_names<VoidFraction>.size() == std::size_t(VoidFraction::centre) + 1);
static_assert(choice_names<Preconditioner>.size() == std::size_t(Preconditioner::local_fft) + 1);

/// The members of coupling.forces, by name.
struct ForceName {
  std::string_view name;
  bool ForceSwitches::*on;
};
inline constexpr std::array<ForceName, 5> force_names{
    {{"drag", &ForceSwitches::drag},
     {"pressure_gradient", &ForceSwitches::pressure_gradient},
     {"stress", &ForceSwitches::stress},
     {"added_mass", &ForceSwitches::added_mass},
     {"buoyancy", &ForceSwitches::buoyancy}}};

/// What a number may be: each of an array, each diameter of size classes; of a text the bytes.
struct Range {
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  double least = -infinite, most = infinite;
  bool above_least = false, below_most = false;       // the bound itself is excluded
  double smallest_size = 0, largest_size = infinite;  // beyond, powers of it leave double precision

  constexpr Range at_most(double bound) const { return with(bound, false); }
  constexpr Range below(double bound) const { return with(bound, true); }
  /// Bounds on the absolute value, wide on purpose: what is merely unusual is the user's business.
  constexpr Range plausible(double smallest, double largest) const {
    Range range = *this;
    range.smallest_size = smallest;
    range.largest_size = largest;
    return range;
  }
  /// "above 0 and at most 1"; empty if there are no bounds.
  std::string text() const;

 private:
  constexpr Range with(double bound, bool excluded) const {
    Range range = *this;
    range.most = bound;
    range.below_most = excluded;
    return range;
  }
};
constexpr Range above(double bound) { return {.least = bound, .above_least = true}; }
constexpr Range at_least(double bound) { return {.least = bound}; }
constexpr Range at_most(double bound) { return {.most = bound}; }
constexpr Range any{};

/// What a value must be and is not, "a number"; nothing if all is well.
using Mismatch = std::optional<std::string>;

/// From TOML. The value stays as it was if the node does not fit.
Mismatch convert(const Node& node, double& value);
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
  const Mismatch mismatch = convert_name(node, choice_names<Choice>, at);
  if (!mismatch) value = static_cast<Choice>(at);
  return mismatch;
}

template <class T>
Mismatch convert(const Node& node, std::optional<T>& value) {
  T inner{};
  const Mismatch mismatch = convert(node, inner);
  if (!mismatch) value = inner;
  return mismatch;
}

template <class T, std::size_t N>
Mismatch convert(const Node& node, std::array<T, N>& value) {
  const auto* elements = std::get_if<NodeArray>(&node.value);
  if (elements == nullptr || elements->size() != N) return fmt::format("an array of {} numbers", N);
  std::array<T, N> read{};
  for (std::size_t n = 0; n < N; ++n) {
    if (const Mismatch mismatch = convert((*elements)[n], read[n])) {
      return fmt::format("an array of {} numbers, each {}", N, *mismatch);
    }
  }
  value = read;
  return {};
}

/// As TOML, with all digits.
std::string toml_text(const std::vector<SizeClass>& value);
std::string toml_text(const ForceSwitches& value);

template <class T>
requires std::is_integral_v<T> std::string toml_text(T value) { return fmt::format("{}", value); }

template <class Choice>
requires std::is_enum_v<Choice> std::string toml_text(Choice value) {
  return toml_text(choice_names<Choice>[static_cast<std::size_t>(value)]);
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

/// Within its range? `unit` of the numbers, for the answer.
Mismatch check(double value, const Range& range, const std::string& unit);
Mismatch check(const std::string& value, const Range& range, const std::string& unit);

template <class T>
Mismatch check(const T& value, const Range& range, const std::string& unit) {
  if constexpr (std::is_integral_v<T>) {
    return check(static_cast<double>(value), range, unit);
  } else if constexpr (std::is_same_v<T, SizeClass>) {
    return check(value.diameter, range, unit);
  } else if constexpr (requires { value.has_value(); }) {
    return value ? check(*value, range, unit) : Mismatch{};
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return {};  // load.cpp looks whether the file is there
  } else if constexpr (requires { value.begin(); }) {
    for (const auto& element : value) {
      if (const Mismatch mismatch = check(element, range, unit)) return mismatch;
    }
  }
  return {};
}

/// What one writes for it, in words: "number", "array of 3 numbers", or the choices.
template <class T>
std::string type_text() {
  if constexpr (std::is_enum_v<T>) {
    return fmt::format("\"{}\"", fmt::join(choice_names<T>, "\", \""));
  } else if constexpr (requires(T value) { value.has_value(); }) {
    return type_text<typename T::value_type>();
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_integral_v<T>) {
    return "integer";
  } else if constexpr (std::is_floating_point_v<T>) {
    return "number";
  } else if constexpr (std::is_convertible_v<T, std::string>) {  // a path, too
    return "text";
  } else if constexpr (std::is_same_v<T, ForceSwitches>) {
    return "array of " + toml_text(ForceSwitches{});
  } else if constexpr (std::is_same_v<T, std::vector<SizeClass>>) {
    return "array of [diameter, count]";
  } else {
    return fmt::format("array of {} {}s", T{}.size(), type_text<typename T::value_type>());
  }
}

}  // namespace barchan
