#include "src/toml/reading.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "src/base/words.hpp"
#include "src/toml/dotted.hpp"
#include "src/toml/keys.hpp"
#include "src/toml/lengths.hpp"

namespace barchan {
namespace {

/// Key of one of several sections, "initial.heap.2.radius", without the number.
std::string without_numbers(std::string_view dotted) {
  std::string key;
  while (!dotted.empty()) {
    const std::size_t dot = std::min(dotted.find('.'), dotted.size());
    const std::string_view part = dotted.substr(0, dot);
    if (part.find_first_not_of("0123456789") != part.npos) key = join(key, part);
    dotted.remove_prefix(std::min(dot + 1, dotted.size()));
  }
  return key;
}

/// Key as TOML needs it written, and a terminal can show it.
std::string shown_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) != 0 || c == '_' || c == '-' || c == ' ';
  });
  return printable(bare ? std::string(key) : toml_text(key), 60);
}

/// Message "[section] key = value: message", without the value when `node` is nullptr; "[key]:
/// message" of a section.
std::string sentence(const std::string& section, const std::string& name, bool is_section,
                     const Node* node, const std::string& message) {
  if (is_section) return fmt::format("[{}]: {}", shown_key(name), message);
  return fmt::format("{}{}{}: {}", section.empty() ? "" : fmt::format("[{}] ", section),
                     shown_key(name), node == nullptr ? "" : " = " + toml_text(*node), message);
}

}  // namespace

ConfigReader::ConfigReader(std::string_view text, const std::filesystem::path& file,
                           const Sections& table)
    : table_(table), file_(file), tree_(parse_toml(text, file.string(), problems_)) {}

/// Names that may stand in a section ("": the file): its keys and the sections in it.
std::vector<std::string> ConfigReader::names_in(const std::string& path) const {
  std::vector<std::string> names;
  for (const Section& section : table_) {
    const auto [outer, name] = split(section.name);
    if (outer == path) names.push_back(name);
    if (section.name != path) continue;
    for (const Key& key : section.keys) names.push_back(key.name);
  }
  return names;
}

bool ConfigReader::is_section(const std::string& dotted) const {
  return std::ranges::any_of(table_,
                             [&](const Section& section) { return section.name == dotted; });
}

void ConfigReader::set(const std::vector<std::string>& assignments) {
  for (const std::string& one : assignments) apply_override(tree_, one, problems_);
  for (const char* key : {"case.base", "case.without"}) {
    if (tree_.find(key) != nullptr)
      report_error(key, "must stand in the file of the case; --set changes single keys of it");
  }
}

void ConfigReader::read(Config& config) {
  for (const Section& section : table_) read(section, config);
  find_unknown("", tree_, names_in(""));
  for (const Section& section : table_) {
    const Node* node = tree_.find(section.name);
    if (node == nullptr) continue;
    const std::vector<std::string> known = names_in(section.name);
    const auto* list = std::get_if<NodeArray>(&node->value);
    if (section.repeated() && list != nullptr) {
      for (const Node& entry : *list) find_unknown(section.name, entry, known);
    } else {
      find_unknown(section.name, *node, known);
    }
  }
}

void ConfigReader::read(const Section& section, Config& config) {
  const Node* node = tree_.find(section.name);
  const bool is_table = node != nullptr && node->table() != nullptr;
  if (section.prepare) section.prepare(config, is_table);
  if (node == nullptr && section.required)
    report_error(section.name, "required section is missing");
  if (node != nullptr && section.repeated()) return read_list(section, *node, config);
  if (node != nullptr && !is_table && !section.keys.empty()) {
    report_error(section.name, fmt::format("must be a section, [{}]", section.name));
  }
  if (is_table) read_keys(section, *node, config, 0);
}

/// Reads a section that may be written many times.
void ConfigReader::read_list(const Section& section, const Node& node, Config& config) {
  const auto* list = std::get_if<NodeArray>(&node.value);
  if (list == nullptr || !std::ranges::all_of(*list, [](const Node& n) { return n.table(); })) {
    return report_error(section.name,
                        fmt::format("must be sections, [[{}]] for each of them", section.name));
  }
  if (list->size() > section.most)
    report_error(section.name, fmt::format("must be at most {} sections", section.most));
  for (std::size_t n = 0; n < std::min(list->size(), section.most); ++n) {
    section.append(config);
    read_keys(section, (*list)[n], config, n);
  }
}

void ConfigReader::read_keys(const Section& section, const Node& table, Config& config,
                             std::size_t entry) {
  for (const Key& key : section.keys) {
    const Node* value = table.find(key.name);
    if (value == nullptr) {
      if (key.required) mismatch(key, nullptr, &table, "required key is missing");
    } else if (value->table() == nullptr || !is_section(key.dotted())) {
      read_value(key, *value, config, entry);
    }
  }
}

void ConfigReader::read_value(const Key& key, const Node& value, Config& config,
                              std::size_t entry) {
  if (is_automatic(key.dotted())) return;
  if (key.takes_diameters && is_in_diameters(value))
    return in_diameters_.push_back({&key, value, entry});
  Node metres = value;
  Mismatch wrong = key.unit == "m" ? make_metres(metres) : Mismatch();
  if (!wrong) wrong = key.read(metres, config, entry);
  if (!wrong) return;
  const std::string gone = removal(key.dotted(), toml_text(value));
  mismatch(key, &value, nullptr, gone.empty() ? "must be " + *wrong : gone);
}

void ConfigReader::settle_lengths(Config& config, double diameter, bool tell) {
  for (auto& [key, value, entry] : in_diameters_) {
    Node metres = value;
    if (diameter == 0) {
      if (tell)
        mismatch(*key, &value, nullptr,
                 "must be in metres: diameters are known only of grains that are poured, in this "
                 "case or in the one it starts from");
      bad_.insert(key->dotted());
    } else if (Mismatch wrong = make_metres(metres, diameter);
               wrong || (wrong = key->read(metres, config, entry))) {
      mismatch(*key, &value, nullptr, "must be " + *wrong);
    }
  }
  in_diameters_.clear();
  for (const Section& section : table_) {
    for (const Key& key : section.keys) {
      Node value{key.by_default, {}};
      if (diameter == 0 || !is_in_diameters(value) || tree_.find(key.dotted()) != nullptr) continue;
      make_metres(value, diameter);
      if (key.text(config, 0) && switched_off_by(key.dotted(), config).empty())
        key.read(value, config, 0);
    }
  }
}

bool ConfigReader::is_automatic(const std::string& dotted) const {
  const auto [name, key] = split(dotted);
  for (const Section& section : table_) {
    if (section.name != name) continue;
    for (const Key& one : section.keys) {
      if (one.name != key || one.by_default != kAutomatic) continue;
      const Node* value = tree_.find(dotted);
      const auto* text = value != nullptr ? std::get_if<std::string>(&value->value) : nullptr;
      return value == nullptr || (text != nullptr && *text == kAutomatic);
    }
  }
  return false;
}

void ConfigReader::mismatch(const Key& key, const Node* value, const Node* around,
                            const std::string& message) {
  report_at(value, around, key.dotted(), message);
  bad_.insert(key.dotted());
}

void ConfigReader::report_at(const Node* node, const Node* around, const std::string& dotted,
                             const std::string& message) {
  const auto [section, name] = split(dotted);
  const Location where = node != nullptr     ? node->where
                         : around != nullptr ? around->where
                                             : Location{file_.string(), 0};
  const bool whole = section.empty() && (node == nullptr || node->table() != nullptr);
  add_problem(where, dotted, whole, node, message);
}

/// The location of a command-line assignment already names its key.
Problem ConfigReader::problem(const Location& where, const std::string& dotted, bool is_section,
                              const Node* node, const std::string& message) const {
  const auto [section, name] = split(dotted);
  if (where.line != 0 || where.file != assigned_name(dotted))
    return {where, sentence(section, name, is_section, node, message)};
  const bool valued = node != nullptr && !is_section;
  const std::string value = valued ? fmt::format(" = {}", toml_text(*node)) : "";
  return {{where.file + value, 0}, message};
}

void ConfigReader::report_conflict(const std::string& dotted, const std::string& message) {
  const std::string section = split(dotted).first;
  report_at(tree_.find(dotted), section.empty() ? nullptr : tree_.find(section), dotted, message);
}

void ConfigReader::report_error(const std::string& dotted, const std::string& message) {
  report_conflict(dotted, message);
  bad_.insert(dotted);
}

bool ConfigReader::is_bad(const std::string& dotted) const {
  for (std::string part = without_numbers(dotted); !part.empty(); part = split(part).first) {
    if (bad_.contains(part)) return true;
  }
  return false;
}

}  // namespace barchan
