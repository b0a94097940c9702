// Reading one section of a configuration: every key typed, limited and known, all complaints kept.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "src/config/names.hpp"
#include "src/config/toml_tree.hpp"

namespace barchan {

/// A bound on a number, each element of an array included.
struct Limit {
  enum class Kind { above, at_least, below, at_most } kind;
  double bound;
};
constexpr Limit above(double bound) { return {Limit::Kind::above, bound}; }
constexpr Limit at_least(double bound) { return {Limit::Kind::at_least, bound}; }
constexpr Limit below(double bound) { return {Limit::Kind::below, bound}; }
constexpr Limit at_most(double bound) { return {Limit::Kind::at_most, bound}; }
using Limits = std::initializer_list<Limit>;

/// The candidate nearest to `typed` by edits (a swap of neighbours counts once); empty if none is
/// near enough to be meant.
std::string nearest(std::string_view typed, std::span<const std::string> candidates);

/// What is gathered while the sections of one file are read.
class Reading {
 public:
  explicit Reading(std::string file) : file_(std::move(file)) {}

  /// "[section] key = value: message", or without the value when it was not written. The key is
  /// bad from then on: nothing is to be concluded from its value.
  void complain(const Location& where, std::string_view section, std::string_view key,
                const Node* node, const std::string& message);
  void complain_about_missing(const std::string& section);
  /// A complaint about a dotted key (or a section) that was read well but does not fit the others,
  /// at the line where it was written, else that of its section, else the file as a whole.
  void contradict(const std::string& dotted_key, const std::string& message);
  /// True if `dotted_key` or the section it is in could not be read as meant.
  bool is_bad(const std::string& dotted_key) const;

  void know(const std::string& section, std::string_view key, const Node* node);
  void unknown(const std::string& section, const std::string& key, const Node& node);
  /// Turns the unknown keys into complaints, now that all valid keys have been named.
  void complain_about_unknown();

  const std::string& file() const { return file_; }
  std::vector<Problem>& problems() { return problems_; }

 private:
  struct Unknown {
    std::string section, key;
    const Node* node;
  };
  std::string section_with(const std::string& key) const;
  std::string suggestion(const Unknown& unknown);
  void add(const Location& where, std::string_view section, std::string_view key, const Node* node,
           const std::string& message);

  std::string file_;
  std::vector<Problem> problems_;
  std::vector<Unknown> unknown_;
  std::map<std::string, std::vector<std::string>> keys_;  // section -> its valid keys
  std::map<std::string, const Node*> written_;            // dotted key -> its value
  std::set<std::string> bad_;                             // dotted keys that could not be read
};

namespace detail {

/// Each returns what is expected when the node does not fit, and leaves the value alone then.
using Mismatch = std::optional<std::string>;
Mismatch convert(const Node& node, double& value);
Mismatch convert(const Node& node, bool& value);
Mismatch convert(const Node& node, int& value);
Mismatch convert(const Node& node, std::int64_t& value);
Mismatch convert(const Node& node, std::uint64_t& value);
Mismatch convert(const Node& node, std::string& value);
Mismatch convert(const Node& node, std::vector<SizeClass>& value);
Mismatch convert(const Node& node, ForceSwitches& value);
/// The index of the name the node holds.
Mismatch convert_name(const Node& node, std::span<const std::string_view> names, std::size_t& at);

template <class Choice>
requires std::is_enum_v<Choice> Mismatch convert(const Node& node, Choice& value) {
  std::size_t at = 0;
  const Mismatch mismatch = convert_name(node, ChoiceNames<Choice>::value, at);
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

std::string array_expectation(std::size_t size, const std::string& element);

template <class T, std::size_t N>
Mismatch convert(const Node& node, std::array<T, N>& value) {
  const auto* elements = std::get_if<NodeArray>(&node.value);
  if (elements == nullptr || elements->size() != N) return array_expectation(N, {});
  std::array<T, N> read{};
  for (std::size_t n = 0; n < N; ++n) {
    if (const Mismatch mismatch = convert((*elements)[n], read[n])) {
      return array_expectation(N, *mismatch);
    }
  }
  value = read;
  return {};
}

bool holds(const Limit& limit, double value);
std::string range_text(Limits limits);

template <class T>
bool within(const T& value, Limits limits) {
  if constexpr (std::is_arithmetic_v<T>) {
    for (const Limit& limit : limits) {
      if (!holds(limit, static_cast<double>(value))) return false;
    }
  } else if constexpr (requires {
                         *value;
                         value.has_value();
                       }) {
    return !value.has_value() || within(*value, limits);
  } else if constexpr (requires {
                         value.begin();
                         typename T::value_type;
                       }) {
    if constexpr (std::is_arithmetic_v<typename T::value_type>) {
      for (const auto& element : value) {
        if (!within(element, limits)) return false;
      }
    }
  }
  return true;
}

}  // namespace detail

/// One table of the file. A missing table reads as empty, and what it requires is then not missed.
class Section {
 public:
  /// `node`: the table, or nullptr. `name`: dotted, as in messages.
  Section(Reading& reading, const Node* node, std::string name);
  ~Section();  // every key nobody asked for is unknown
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;

  bool present() const { return node_ != nullptr; }

  template <class T>
  void require(std::string_view key, T& value, Limits limits = {}) {
    const Node* node = take(key);
    if (node != nullptr) {
      read(key, *node, value, limits);
    } else if (present()) {
      reading_.complain(node_->where, name_, key, nullptr, "required key is missing");
    }
  }

  template <class T>
  void optional(std::string_view key, T& value, Limits limits = {}) {
    if (const Node* node = take(key)) read(key, *node, value, limits);
  }

  /// The node of a key read by hand, or nullptr. Counts as known from then on.
  const Node* take(std::string_view key);
  void complain(std::string_view key, const Node& node, const std::string& message) {
    reading_.complain(node.where, name_, key, &node, message);
  }

 private:
  template <class T>
  void read(std::string_view key, const Node& node, T& value, Limits limits) {
    T candidate = value;
    if (const detail::Mismatch mismatch = detail::convert(node, candidate)) {
      complain(key, node, "must be " + *mismatch);
    } else if (!detail::within(candidate, limits)) {
      complain(key, node, "must be " + detail::range_text(limits));
    } else {
      value = candidate;
    }
  }

  Reading& reading_;
  const Node* node_;
  std::string name_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace barchan
