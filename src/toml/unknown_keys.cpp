#include <fmt/format.h>

#include "src/base/words.hpp"
#include "src/toml/dotted.hpp"
#include "src/toml/keys.hpp"
#include "src/toml/reading.hpp"

namespace barchan {
namespace {

std::string elsewhere(const std::string& key, const std::string& home) {
  return fmt::format(" (did you mean \"{}\" of [{}]?)", key, home);
}

}  // namespace

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

/// Hint " (did you mean ...?)" for keys that are there, named from within `section`; they were not
/// read.
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
    bad_.insert(join(section, close));  // its meaning was not read
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
