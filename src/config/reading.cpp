#include "src/config/reading.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "src/base/words.hpp"
#include "src/config/keys.hpp"
#include "src/config/synonyms.hpp"

namespace barchan {
namespace {

std::string join(std::string_view section, std::string_view name) {
  return section.empty() ? std::string(name) : fmt::format("{}.{}", section, name);
}

/// The section of a dotted key and its name there.
std::pair<std::string, std::string> split(const std::string& dotted) {
  const std::size_t dot = dotted.rfind('.');
  if (dot == std::string::npos) return {"", dotted};
  return {dotted.substr(0, dot), dotted.substr(dot + 1)};
}

/// A key of one of several sections, "initial.heap.2.radius", as that of all of them.
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

/// A key as TOML needs it written, and a terminal can show it.
std::string shown_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) != 0 || c == '_' || c == '-' || c == ' ';
  });
  return printable(bare ? std::string(key) : toml_text(key), 60);
}

/// "[section] key = value: message", without the value when `node` is nullptr; "[key]: message" of
/// a section.
std::string sentence(const std::string& section, const std::string& name, bool is_section,
                     const Node* node, const std::string& message) {
  if (is_section) return fmt::format("[{}]: {}", shown_key(name), message);
  return fmt::format("{}{}{}: {}", section.empty() ? "" : fmt::format("[{}] ", section),
                     shown_key(name), node == nullptr ? "" : " = " + toml_text(*node), message);
}

std::string elsewhere(const std::string& key, const std::string& home) {
  return fmt::format(" (did you mean \"{}\" of [{}]?)", key, home);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

struct Removed {
  std::string_view key, value, why;  // no value: the key as a whole
};
constexpr Removed kRemoved[] = {
    {"coupling.relaxation", "", "the exchange needs none any more; delete this line"},
    {"solver.correctors", "", "one correction of the pressure a step is exact; delete this line"},
    {"solver.preconditioner", "\"jacobi\"", "take \"local_fft\", the default, or \"fft\""},
    {"solver.preconditioner", "\"none\"", "take \"local_fft\", the default, or \"fft\""}};

/// Why a key (`value` empty) or a value of a key, as TOML, is no longer there; empty if it is, or
/// never was.
std::string removal(std::string_view dotted, std::string_view value) {
  for (const Removed& one : kRemoved) {
    if (one.key != dotted || one.value != value) continue;
    return fmt::format("was removed after version 0.1.0: {}", one.why);
  }
  return {};
}

}  // namespace

ConfigReader::ConfigReader(std::string_view text, const std::filesystem::path& file,
                           const Sections& table)
    : table_(table), file_(file), tree_(parse_toml(text, file.string(), problems_)) {}

/// What may stand in a section ("": the file): its keys and the sections in it.
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
}

bool ConfigReader::is_assigned(const std::string& dotted) const {
  const Node* node = tree_.find(dotted);
  return node != nullptr && node->where.line == 0;
}

void ConfigReader::drop(const std::string& dotted) {
  NodeTable* table = tree_.table();
  std::string name = dotted;
  for (std::size_t dot = name.find('.'); table && dot != name.npos; dot = name.find('.')) {
    const auto at = table->find(name.substr(0, dot));
    table = at == table->end() ? nullptr : at->second.table();
    name.erase(0, dot + 1);
  }
  if (table != nullptr) table->erase(name);
}

Config ConfigReader::read() {
  Config config;
  config.file = file_;
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
  return config;
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

/// A section that may be written many times.
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
  const auto bad = [&](const Key& key, const Node* value, const std::string& message) {
    report_at(value, &table, key.dotted(), message);
    bad_.insert(key.dotted());
  };
  for (const Key& key : section.keys) {
    const Node* value = table.find(key.name);
    if (value == nullptr) {
      if (key.required) bad(key, nullptr, "required key is missing");
    } else if (value->table() == nullptr || !is_section(key.dotted())) {
      if (const Mismatch mismatch = key.read(*value, config, entry)) {
        const std::string gone = removal(key.dotted(), toml_text(*value));
        bad(key, value, gone.empty() ? "must be " + *mismatch : gone);
      }
    }
  }
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

/// What was assigned on the command line names its key already.
void ConfigReader::add_problem(const Location& where, const std::string& dotted, bool is_section,
                               const Node* node, const std::string& message) {
  const auto [section, name] = split(dotted);
  if (where.line != 0 || where.file != assigned_name(dotted)) {
    problems_.push_back({where, sentence(section, name, is_section, node, message)});
    return;
  }
  const bool valued = node != nullptr && !is_section;
  const std::string value = valued ? fmt::format(" = {}", toml_text(*node)) : "";
  problems_.push_back({{where.file + value, 0}, message});
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

void ConfigReader::find_unknown(const std::string& section, const Node& node,
                                const std::vector<std::string>& known) {
  if (node.table() == nullptr) return;
  for (const auto& [name, value] : *node.table()) {
    if (contains(known, name)) continue;
    const bool table = section.empty() && value.table() != nullptr;
    std::string why = removal(join(section, name), "");
    if (why.empty()) {
      // A file of another kind may hold very many; they need not all be compared with ours.
      const std::string hint = ++unknown_ > 100 ? std::string() : suggestion(section, name, table);
      why = fmt::format("unknown {}{}", table ? "section" : "key", hint);
    }
    add_problem(value.where, join(section, name), table, nullptr, why);
  }
}

/// " (did you mean ...?)" for keys that are there, named from within `section`; they were not read.
std::string ConfigReader::hint(const std::string& section, std::string_view keys) {
  const std::vector<std::string> here = names_in(section);
  std::string text;
  while (!keys.empty()) {
    const std::size_t end = std::min(keys.find(", "), keys.size());
    const auto [home, name] = split(std::string(keys.substr(0, end)));
    keys.remove_prefix(std::min(end + 2, keys.size()));
    if (!contains(names_in(home), name)) continue;
    const bool is_here = contains(here, name);
    bad_.insert(join(is_here ? section : home, name));
    text += fmt::format("{}\"{}\"{}", text.empty() ? " (did you mean " : " or ", name,
                        is_here ? "" : fmt::format(" of [{}]", home));
  }
  return text.empty() ? text : text + "?)";
}

std::string ConfigReader::suggestion(const std::string& section, const std::string& name,
                                     bool table) {
  if (!table) {
    if (std::string text = hint(section, keys_meant_by(name, section)); !text.empty()) return text;
    for (const Section& other : table_) {
      if (contains(names_in(other.name), name)) return elsewhere(name, other.name);
    }
  }
  const std::string close = nearest(name, names_in(section));
  if (!close.empty()) {
    bad_.insert(join(section, close));  // what it stands for was not read
    return did_you_mean(close);
  }
  if (table) return {};
  std::vector<std::string> all;
  for (const Section& other : table_) {
    const std::vector<std::string> names = names_in(other.name);
    all.insert(all.end(), names.begin(), names.end());
  }
  const std::string near = nearest(name, all);
  for (const Section& other : table_) {
    if (contains(names_in(other.name), near)) return elsewhere(near, other.name);
  }
  return {};
}

}  // namespace barchan
