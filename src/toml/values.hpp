// Values of keys: read from TOML, checked against their range, written as TOML.
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

#include "kernels/math/alternatives.hpp"
#include "src/base/enum_names.hpp"
#include "src/toml/toml_tree.hpp"

namespace barchan {

/// Value that is one of a few words: an enumerator, or a type of a list.
template <class T>
concept HasWords = std::is_enum_v<T> || requires {
  T::Of::words;
};
template <HasWords T>
constexpr const auto& words_of() {
  if constexpr (std::is_enum_v<T>) {
    return kEnumNames<T>;
  } else {
    return T::Of::words;
  }
}
template <HasWords T>
constexpr std::string_view word_of(T value) {
  if constexpr (std::is_enum_v<T>) {
    return kEnumNames<T>[static_cast<std::size_t>(value)];
  } else {
    return value.word();
  }
}

/// Description of a type of the program's own: in words, `type()`, and for programs, `form()`
/// (form.hpp). Beside it stand convert, toml_text and check of that type.
template <class T>
struct ValueKind;

/// Meaning of a key, and of each alternative that it names.
template <class T>
std::string meaning_of(std::string meaning) {
  if constexpr (requires { T::Of::named; }) {
    for (const Named& one : T::Of::named)
      meaning += fmt::format("; \"{}\": {}", one.word, one.meaning);
  }
  return meaning;
}

/// Range of a number: of each in an array, of each diameter of size classes, of the bytes of a
/// text. It is wide on purpose: what is merely unusual is the user's business, but powers of it
/// must be numbers.
struct Range {
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  double min = -infinite, max = infinite;
  bool above_min = false, below_max = false;  // the bound itself is excluded

  constexpr Range at_most(double bound) const { return {min, bound, above_min, false}; }
  constexpr Range below(double bound) const { return {min, bound, above_min, true}; }
  /// Range in words: "above 0 and at most 1"; empty if there are no bounds.
  std::string text() const;
};
constexpr Range above(double bound) { return {.min = bound, .above_min = true}; }
constexpr Range at_least(double bound) { return {.min = bound}; }
constexpr Range at_most(double bound) { return {.max = bound}; }
constexpr Range between(double min, double max) { return {min, max}; }
constexpr Range any{};

/// Type that is given for a T: for an optional, that of its value.
template <class T>
T plain(const T&);
template <class T>
T plain(const std::optional<T>&);
template <class T>
using Plain = decltype(plain(std::declval<T>()));

/// Mismatch: what a value must be and is not, "a number"; empty if all is well.
using Mismatch = std::optional<std::string>;

/// Converts a value from TOML; after a mismatch it is of no use.
Mismatch convert(const Node& node, double& value);
Mismatch convert(const Node& node, bool& value);
Mismatch convert(const Node& node, std::string& value);
Mismatch convert(const Node& node, std::filesystem::path& value);
/// Finds the index of the name that the node holds.
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

template <HasWords T>
Mismatch convert(const Node& node, T& value) {
  std::size_t at = 0;
  const Mismatch mismatch = convert_name(node, words_of<T>(), at);
  if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>(at);
  } else {
    value = {at};
  }
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

/// String in TOML, quoted and escaped.
std::string toml_text(std::string_view text);
/// Shortest text in TOML that reads back as the same number, always a float ("2.0", "1e-06").
std::string toml_text(double value);
/// Text of a value as one would write it in a file, cut after 60 characters.
std::string toml_text(const Node& node);

template <class T>
requires std::is_integral_v<T> std::string toml_text(T value) { return fmt::format("{}", value); }

template <HasWords T>
std::string toml_text(T value) {
  return toml_text(word_of(value));
}

template <class T, std::size_t N>
std::string toml_text(const std::array<T, N>& values) {
  std::string text;
  for (const T& value : values) text += (text.empty() ? "" : ", ") + toml_text(value);
  return "[" + text + "]";
}

/// Text of a value in TOML; empty if it is not given.
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

/// Checks a value against its range.
Mismatch check(double value, const Range& range);
Mismatch check(const std::string& value, const Range& range);

template <class T>
Mismatch check(const T& value, const Range& range) {
  if constexpr (std::is_integral_v<T>) {
    return check(static_cast<double>(value), range);
  } else if constexpr (requires { value.data(); }) {
    for (const auto& element : value) {
      if (const Mismatch mismatch = check(element, range)) return mismatch;
    }
  }
  return {};  // a choice, forces; a path: load.cpp looks whether the file is there
}

/// Type in words: "number", "array of 3 numbers", or the choices.
template <class T>
std::string type_text() {
  if constexpr (requires { ValueKind<T>::type(); }) {
    return ValueKind<T>::type();
  } else if constexpr (HasWords<T>) {
    return fmt::format("\"{}\"", fmt::join(words_of<T>(), "\", \""));
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_integral_v<T>) {
    return "integer";
  } else if constexpr (std::is_floating_point_v<T>) {
    return "number";
  } else if constexpr (std::is_convertible_v<T, std::string>) {  // a path, too
    return "text";
  } else {
    return fmt::format("array of {} {}s", T{}.size(), type_text<typename T::value_type>());
  }
}

}  // namespace barchan
