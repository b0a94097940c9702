#include "src/config/restart_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "src/config/resolved.hpp"

namespace barchan {

namespace {

/// What the numbers of a restart file mean depends on these.
constexpr std::string_view kept_keys[] = {
    "domain.size",    "fluid.cells",       "fluid.first_cell_height", "time.fluid_step",
    "grains.density", "grains.boundary_x", "grains.boundary_z"};

bool is_kept(const std::string& key) {
  return std::find(std::begin(kept_keys), std::end(kept_keys), key) != std::end(kept_keys);
}

/// Values of a resolved configuration by dotted key.
std::map<std::string, std::string> values_of(const Config& config) {
  const std::string text = to_toml(config);
  std::map<std::string, std::string> values;
  std::string section;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const std::size_t equals = line.find(" = ");
    if (line.starts_with('[')) {
      section = line.substr(1, line.size() - 2);
    } else if (equals != line.npos) {
      values[section + "." + line.substr(0, equals)] = line.substr(equals + 3);
    }
  }
  return values;
}

struct Change {
  std::string key, before, now;
};

std::vector<Change> changes(const Config& config, const Config& written) {
  const auto now = values_of(config), before = values_of(written);
  std::vector<Change> all;
  for (const auto& [key, value] : now) {
    const auto at = before.find(key);
    const std::string was = at == before.end() ? "absent" : at->second;
    if (was != value) all.push_back({key, was, value});
  }
  for (const auto& [key, value] : before) {
    if (!now.contains(key)) all.push_back({key, value, "absent"});
  }
  return all;
}

}  // namespace

std::vector<std::string> restart_conflicts(const Config& config, const Config& written) {
  std::vector<std::string> conflicts;
  const auto section = [&](const char* name, bool here, bool there) {
    if (here == there) return;
    conflicts.push_back(
        fmt::format("{}: it was written by a case with{} this section", name, there ? "" : "out"));
  };
  section("[fluid]", config.fluid.has_value(), written.fluid.has_value());
  section("[grains]", config.grains.has_value(), written.grains.has_value());
  if (!conflicts.empty()) return conflicts;
  for (const Change& c : changes(config, written)) {
    if (!is_kept(c.key)) continue;
    conflicts.push_back(fmt::format("{} = {}: it was written with {}", c.key, c.now, c.before));
  }
  return conflicts;
}

std::vector<std::string> changed_keys(const Config& config, const Config& written) {
  std::vector<std::string> keys;
  for (const Change& c : changes(config, written)) {
    if (!is_kept(c.key)) keys.push_back(fmt::format("{} {} -> {}", c.key, c.before, c.now));
  }
  return keys;
}

}  // namespace barchan
