#include "src/config/values.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/words.hpp"

namespace barchan {

std::string Range::text() const {
  std::string words;
  if (least > -infinite) words = fmt::format("{} {}", above_least ? "above" : "at least", least);
  if (most == infinite) return words;
  return fmt::format("{}{}{} {}", words, words.empty() ? "" : " and ",
                     below_most ? "below" : "at most", most);
}

namespace {

template <class T>
Mismatch take(const Node& node, T& value, const char* expected) {
  const T* given = std::get_if<T>(&node.value);
  if (given == nullptr) return expected;
  value = *given;
  return {};
}

}  // namespace

Mismatch convert(const Node& node, double& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
    value = static_cast<double>(*integer);
    return {};
  }
  double number = 0;
  if (Mismatch mismatch = take(node, number, "a number")) return mismatch;
  if (!std::isfinite(number)) return "a finite number";
  value = number;
  return {};
}

Mismatch convert(const Node& node, bool& value) { return take(node, value, "true or false"); }

Mismatch convert(const Node& node, std::string& value) { return take(node, value, "a string"); }

Mismatch convert(const Node& node, std::filesystem::path& value) {
  std::string text;
  const Mismatch mismatch = convert(node, text);
  if (!mismatch) value = text;
  return mismatch;
}

Mismatch convert(const Node& node, std::vector<SizeClass>& value) {
  std::string expected = "an array of [diameter in m above 0, count above 0]";
  const auto* classes = std::get_if<NodeArray>(&node.value);
  if (classes == nullptr) return expected;
  constexpr std::int64_t most = std::numeric_limits<int>::max();  // what a run can number
  std::int64_t total = 0;
  std::vector<SizeClass> read;
  for (const Node& element : *classes) {
    const auto* pair = std::get_if<NodeArray>(&element.value);
    SizeClass size;
    if (pair == nullptr || pair->size() != 2 || convert((*pair)[0], size.diameter) ||
        convert((*pair)[1], size.count) || size.diameter <= 0 || size.count <= 0) {
      return fmt::format("{}; {} is not", expected, toml_text(element));
    }
    if (size.count > most - total) return fmt::format("sizes of at most {} grains in all", most);
    total += size.count;
    read.push_back(size);
  }
  value = read;
  return {};
}

Mismatch convert(const Node& node, ForceSwitches& value) {
  std::vector<std::string_view> names;
  for (const ForceName& force : force_names) names.push_back(force.name);
  ForceSwitches read{false, false, false, false, false};
  const auto* chosen = std::get_if<NodeArray>(&node.value);
  if (chosen == nullptr) return fmt::format("an array of \"{}\"", fmt::join(names, "\", \""));
  for (const Node& element : *chosen) {
    std::size_t at = 0;
    if (const Mismatch mismatch = convert_name(element, names, at)) {
      return fmt::format("an array; {} must be {}", toml_text(element), *mismatch);
    }
    read.*force_names[at].on = true;
  }
  value = read;
  return {};
}

Mismatch convert_name(const Node& node, std::span<const std::string_view> names, std::size_t& at) {
  std::string allowed = fmt::format("one of \"{}\"", fmt::join(names, "\", \""));
  const auto* text = std::get_if<std::string>(&node.value);
  if (text == nullptr) return allowed;
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found == names.end()) {
    const std::vector<std::string> candidates(names.begin(), names.end());
    const std::string close = nearest(*text, candidates);
    return close.empty() ? allowed : fmt::format("{} (did you mean \"{}\"?)", allowed, close);
  }
  at = static_cast<std::size_t>(found - names.begin());
  return {};
}

std::string toml_text(const std::vector<SizeClass>& sizes) {
  std::vector<std::string> classes;
  for (const SizeClass& size : sizes) {
    classes.push_back(fmt::format("[{}, {}]", toml_text(size.diameter), size.count));
  }
  return fmt::format("[{}]", fmt::join(classes, ", "));
}

std::string toml_text(const ForceSwitches& forces) {
  std::vector<std::string> names;
  for (const ForceName& force : force_names) {
    if (forces.*force.on) names.push_back(toml_text(force.name));
  }
  return fmt::format("[{}]", fmt::join(names, ", "));
}

Mismatch check(double value, const Range& r, const std::string& unit) {
  const bool too_low = r.above_least ? value <= r.least : value < r.least;
  const bool too_high = r.below_most ? value >= r.most : value > r.most;
  if (too_low || too_high) return r.text();
  const double size = std::abs(value);
  if (size >= r.smallest_size && size <= r.largest_size) return {};
  const bool small = size < r.smallest_size;
  return fmt::format("at {} {:g}{} to be computed with", small ? "least" : "most",
                     small ? r.smallest_size : r.largest_size, unit.empty() ? "" : " " + unit);
}

Mismatch check(const std::string& value, const Range& range, const std::string& /*unit*/) {
  if (printable_lines(value) != value) return "text without control characters";
  if (static_cast<double>(value.size()) > range.most) {
    return fmt::format("at most {} bytes long", range.most);
  }
  return {};
}

}  // namespace barchan
