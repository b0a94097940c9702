#include "src/toml/values.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/words.hpp"

namespace barchan {
namespace {

template <class T>
Mismatch take(const Node& node, T& value, const char* expected) {
  const T* given = std::get_if<T>(&node.value);
  if (given == nullptr) return expected;
  value = *given;
  return {};
}

constexpr std::size_t kLongestShown = 60;  // bytes of a value

/// Prints a value as one would write it in a file; a long list is cut.
struct Printer {
  std::string operator()(const NodeTable& table) const {
    std::vector<std::string> entries;
    for (const auto& [key, node] : table) {
      if (entries.size() > kLongestShown) break;
      entries.push_back(fmt::format("{} = {}", key, std::visit(*this, node.value)));
    }
    return fmt::format("{{ {} }}", fmt::join(entries, ", "));
  }
  std::string operator()(const NodeArray& array) const {
    std::vector<std::string> elements;
    for (const Node& node : array) {
      if (elements.size() > kLongestShown) break;
      elements.push_back(std::visit(*this, node.value));
    }
    return fmt::format("[{}]", fmt::join(elements, ", "));
  }
  std::string operator()(const DateOrTime& date) const { return date.text; }
  template <class T>
  std::string operator()(const T& scalar) const {
    return toml_text(scalar);
  }
};

}  // namespace

std::string Range::text() const {
  std::string words;
  if (min > -infinite) words = fmt::format("{} {:g}", above_min ? "above" : "at least", min);
  if (max == infinite) return words;
  return fmt::format("{}{}{} {:g}", words, words.empty() ? "" : " and ",
                     below_max ? "below" : "at most", max);
}

Mismatch convert(const Node& node, double& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
    value = static_cast<double>(*integer);
    return {};
  }
  const Mismatch mismatch = take(node, value, "a number");
  return !mismatch && !std::isfinite(value) ? "a finite number" : mismatch;
}

Mismatch convert(const Node& node, bool& value) { return take(node, value, "true or false"); }

Mismatch convert(const Node& node, std::string& value) { return take(node, value, "a string"); }

Mismatch convert(const Node& node, std::filesystem::path& value) {
  std::string text;
  const Mismatch mismatch = convert(node, text);
  value = text;
  return mismatch;
}

Mismatch convert_name(const Node& node, std::span<const std::string_view> names, std::size_t& at) {
  std::string allowed = fmt::format("one of \"{}\"", fmt::join(names, "\", \""));
  const auto* text = std::get_if<std::string>(&node.value);
  if (text == nullptr) return allowed;
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found == names.end()) {
    const std::vector<std::string> candidates(names.begin(), names.end());
    return allowed + did_you_mean(nearest(*text, candidates));
  }
  at = static_cast<std::size_t>(found - names.begin());
  return {};
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += fmt::format("\\u{:04X}", static_cast<int>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string toml_text(double value) {
  std::string text = fmt::format("{}", value);
  // Text of only digits and a sign would be an integer in TOML. (inf and nan stay as they are.)
  if (text.find_first_not_of("-0123456789") == text.npos) text += ".0";
  return text;
}

std::string toml_text(const Node& node) {
  const std::string text = std::visit(Printer{}, node.value);
  return text.size() <= kLongestShown ? text : text.substr(0, kLongestShown - 3) + "...";
}

Mismatch check(double value, const Range& r) {
  const bool too_low = r.above_min ? value <= r.min : value < r.min;
  const bool too_high = r.below_max ? value >= r.max : value > r.max;
  return too_low || too_high ? Mismatch(r.text()) : Mismatch();
}

Mismatch check(const std::string& value, const Range& range) {
  if (printable_lines(value) != value) return "text without control characters";
  if (static_cast<double>(value.size()) > range.max) {
    return fmt::format("at most {} bytes long", range.max);
  }
  return {};
}

}  // namespace barchan
