#include "src/config/section.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "src/base/printable.hpp"

namespace barchan {
namespace {

/// Damerau-Levenshtein distance (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above_row(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above_row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = above_row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({change, above_row[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before = above_row;
    above_row = row;
  }
  return above_row[b.size()];
}

bool same_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

/// A key as TOML needs it written, and a terminal can show it.
std::string shown_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) != 0 || c == '_' || c == '-' || c == ' ';
  });
  return printable(bare ? std::string(key) : toml_quoted(key), 60);
}

std::string dotted(std::string_view section, std::string_view key) {
  if (section.empty()) return std::string(key);
  return fmt::format("{}.{}", section, key);
}

}  // namespace

std::string nearest(std::string_view typed, std::span<const std::string> candidates) {
  std::string best;
  const std::size_t most = typed.size() < 4 ? 1 : std::max<std::size_t>(2, typed.size() / 3);
  std::size_t least = most + 1;
  for (const std::string& candidate : candidates) {
    if (same_but_for_case(typed, candidate)) return candidate;
    const std::size_t distance = edit_distance(typed, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

void Reading::add(const Location& where, std::string_view section, std::string_view key,
                  const Node* node, const std::string& message) {
  std::string text = section.empty() ? std::string() : fmt::format("[{}] ", section);
  text += shown_key(key);
  if (node != nullptr) text += " = " + toml_text(*node);
  problems_.push_back({where, fmt::format("{}: {}", text, message)});
}

void Reading::complain(const Location& where, std::string_view section, std::string_view key,
                       const Node* node, const std::string& message) {
  add(where, section, key, node, message);
  bad_.insert(dotted(section, key));
}

void Reading::complain_about_missing(const std::string& section) {
  problems_.push_back({{file_, 0}, fmt::format("[{}]: required section is missing", section)});
  bad_.insert(section);
}

void Reading::contradict(const std::string& dotted_key, const std::string& message) {
  const auto at = written_.find(dotted_key);
  const Node* node = at == written_.end() ? nullptr : at->second;
  const std::size_t dot = dotted_key.rfind('.');
  if (dot == std::string::npos) {  // a section as a whole
    problems_.push_back({node != nullptr ? node->where : Location{file_, 0},
                         fmt::format("[{}]: {}", dotted_key, message)});
    return;
  }
  const std::string section = dotted_key.substr(0, dot);
  const auto around = written_.find(section);
  Location where{file_, 0};
  if (node != nullptr) {
    where = node->where;
  } else if (around != written_.end()) {
    where = around->second->where;
  }
  add(where, section, dotted_key.substr(dot + 1), node, message);
}

bool Reading::is_bad(const std::string& dotted_key) const {
  for (std::size_t end = dotted_key.size(); end != std::string::npos;
       end = end == 0 ? std::string::npos : dotted_key.rfind('.', end - 1)) {
    if (bad_.contains(dotted_key.substr(0, end))) return true;
  }
  return false;
}

void Reading::know(const std::string& section, std::string_view key, const Node* node) {
  keys_[section].emplace_back(key);
  if (node != nullptr) written_[dotted(section, key)] = node;
}

void Reading::unknown(const std::string& section, const std::string& key, const Node& node) {
  unknown_.push_back({section, key, &node});
}

/// The section that knows exactly this key, apart from the one it was written in.
std::string Reading::section_with(const std::string& key) const {
  for (const auto& [section, keys] : keys_) {
    if (!section.empty() && std::find(keys.begin(), keys.end(), key) != keys.end()) return section;
  }
  return {};
}

std::string Reading::suggestion(const Unknown& unknown) {
  const bool is_section = unknown.section.empty() && unknown.node->table() != nullptr;
  const std::string home = is_section ? std::string() : section_with(unknown.key);
  if (!home.empty()) return fmt::format(" (did you mean \"{}\" of [{}]?)", unknown.key, home);
  const auto own = keys_.find(unknown.section);
  if (own != keys_.end()) {
    const std::string close = nearest(unknown.key, own->second);
    if (!close.empty()) {
      // What it stands for was not read, so nothing is to be concluded from its default.
      bad_.insert(dotted(unknown.section, close));
      return fmt::format(" (did you mean \"{}\"?)", close);
    }
  }
  if (is_section) return {};
  for (const auto& [section, keys] : keys_) {
    const std::string close = nearest(unknown.key, keys);
    if (!close.empty() && !section.empty()) {
      return fmt::format(" (did you mean \"{}\" of [{}]?)", close, section);
    }
  }
  return {};
}

void Reading::complain_about_unknown() {
  std::size_t hints = 0;
  for (const Unknown& unknown : unknown_) {
    const bool is_section = unknown.node->table() != nullptr && unknown.section.empty();
    // A file of another kind may hold very many; they need not all be compared with ours.
    const std::string hint = ++hints > 100 ? std::string() : suggestion(unknown);
    if (is_section) {
      problems_.push_back({unknown.node->where,
                           fmt::format("[{}]: unknown section{}", shown_key(unknown.key), hint)});
    } else {
      complain(unknown.node->where, unknown.section, unknown.key, nullptr, "unknown key" + hint);
    }
  }
  unknown_.clear();
}

Section::Section(Reading& reading, const Node* node, std::string name)
    : reading_(reading), node_(node), name_(std::move(name)) {
  if (node_ != nullptr && node_->table() == nullptr) {
    const std::size_t dot = name_.rfind('.');
    const std::string key = dot == std::string::npos ? name_ : name_.substr(dot + 1);
    reading_.complain(node_->where, dot == std::string::npos ? "" : name_.substr(0, dot), key,
                      node_, fmt::format("must be a section, [{}]", name_));
    node_ = nullptr;
  }
}

Section::~Section() {
  if (node_ == nullptr) return;
  for (const auto& [key, node] : *node_->table()) {
    if (!asked_.contains(key)) reading_.unknown(name_, key, node);
  }
}

const Node* Section::take(std::string_view key) {
  const Node* node = node_ != nullptr ? node_->find(key) : nullptr;
  asked_.emplace(key);
  reading_.know(name_, key, node);
  return node;
}

namespace detail {

Mismatch convert(const Node& node, double& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
    value = static_cast<double>(*integer);
    return {};
  }
  const auto* number = std::get_if<double>(&node.value);
  if (number == nullptr) return "a number";
  if (!std::isfinite(*number)) return "a finite number";
  value = *number;
  return {};
}

Mismatch convert(const Node& node, bool& value) {
  const auto* flag = std::get_if<bool>(&node.value);
  if (flag == nullptr) return "true or false";
  value = *flag;
  return {};
}

Mismatch convert(const Node& node, std::int64_t& value) {
  const auto* integer = std::get_if<std::int64_t>(&node.value);
  if (integer == nullptr) return "an integer";
  value = *integer;
  return {};
}

Mismatch convert(const Node& node, int& value) {
  std::int64_t wide = 0;
  if (const Mismatch mismatch = convert(node, wide)) return mismatch;
  constexpr int most = std::numeric_limits<int>::max();
  if (wide > most || wide < -most) return fmt::format("an integer up to {}", most);
  value = static_cast<int>(wide);
  return {};
}

Mismatch convert(const Node& node, std::uint64_t& value) {
  std::int64_t wide = 0;
  if (convert(node, wide) || wide < 0) return "an integer, at least 0";
  value = static_cast<std::uint64_t>(wide);
  return {};
}

Mismatch convert(const Node& node, std::string& value) {
  const auto* text = std::get_if<std::string>(&node.value);
  if (text == nullptr) return "a string";
  value = *text;
  return {};
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

std::string array_expectation(std::size_t size, const std::string& element) {
  return element.empty() ? fmt::format("an array of {} numbers", size)
                         : fmt::format("an array of {} numbers, each {}", size, element);
}

bool holds(const Limit& limit, double value) {
  switch (limit.kind) {
    case Limit::Kind::above:
      return value > limit.bound;
    case Limit::Kind::at_least:
      return value >= limit.bound;
    case Limit::Kind::below:
      return value < limit.bound;
    case Limit::Kind::at_most:
      return value <= limit.bound;
  }
  return false;
}

std::string range_text(Limits limits) {
  constexpr std::array<std::string_view, 4> words{"above", "at least", "below", "at most"};
  std::string text;
  for (const Limit& limit : limits) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " and ",
                        words[static_cast<std::size_t>(limit.kind)], limit.bound);
  }
  return text;
}

}  // namespace detail
}  // namespace barchan
