#include "src/config/resolved.hpp"

#include <fmt/format.h>

#include "src/config/keys.hpp"

namespace barchan {
namespace {

/// The keys in which two cases differ.
std::vector<const Key*> differences(const Config& a, const Config& b, bool fixed_by_restart) {
  std::vector<const Key*> keys;
  for (const Section& section : sections()) {
    for (const Key& key : section.keys) {
      if (key.fixed_by_restart == fixed_by_restart && key.text(a) != key.text(b))
        keys.push_back(&key);
    }
  }
  return keys;
}

std::string shown(const Key& key, const Config& config) {
  return key.text(config).value_or("absent");
}

/// Type, choices or range, as in "number, above 0 and at most 1".
std::string domain_of(const Key& key) {
  const std::string range = key.range.text();
  if (range.empty()) return key.type;
  return fmt::format("{}, {}{}", key.type, range, key.type == "text" ? " bytes" : "");
}

std::string row(const Key& key, const Config& defaults) {
  const std::string value = key.text(defaults).value_or("");
  const bool none = value.empty() || value == "\"\"" || value == "[]";
  const std::string by_default = key.required                   ? "required"
                                 : key.section == "grains.wall" ? "as in `[grains]`"
                                 : none                         ? "none"
                                                                : "`" + value + "`";
  return fmt::format("| `{}` | {} | {} | {} | {}{} |\n", key.name, domain_of(key), key.unit,
                     by_default, key.meaning, key.fixed_by_restart ? " (R)" : "");
}

}  // namespace

std::string to_toml(const Config& config) {
  std::string text;
  for (const Section& section : sections()) {
    std::string lines;
    for (const Key& key : section.keys) {
      if (const auto value = key.text(config)) lines += fmt::format("{} = {}\n", key.name, *value);
    }
    if (lines.empty()) continue;
    text += fmt::format("{}[{}]\n{}", text.empty() ? "" : "\n", section.name, lines);
  }
  return text;
}

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
  for (const Key* key : differences(config, written, true)) {
    conflicts.push_back(fmt::format("{} = {}: it was written with {}", key->dotted(),
                                    shown(*key, config), shown(*key, written)));
  }
  return conflicts;
}

std::vector<std::string> changed_keys(const Config& config, const Config& written) {
  std::vector<std::string> keys;
  for (const Key* key : differences(config, written, false)) {
    keys.push_back(
        fmt::format("{} {} -> {}", key->dotted(), shown(*key, written), shown(*key, config)));
  }
  return keys;
}

std::string keys_page() {
  std::string page =
      "# Keys of a case\n\n"
      "Printed by `./barchan keys`; the table is `src/config/keys.cpp`. All numbers are in SI "
      "units.\n`--set section.key=value` changes a key for one run. Keys marked (R) must be the "
      "same in a restart\nas in the run that wrote the restart file. Numbers within these ranges "
      "may still be refused\nif they do not fit other keys. A length `\"3 d\"` is in mean "
      "diameters, "
      "by number, of the grains\nthat are poured here or in the case that this one starts from; "
      "`check` prints it in metres.\n";
  Config defaults;
  for (const Section& section : sections()) {
    if (section.prepare) section.prepare(defaults, true);
    if (section.keys.empty()) continue;
    page += fmt::format("\n## [{}]\n\n{}{}.\n\n", section.name, section.meaning,
                        section.required ? " (required)" : "");
    page += "| key | type, range | unit | default | meaning |\n|---|---|---|---|---|\n";
    for (const Key& key : section.keys) page += row(key, defaults);
  }
  return page;
}

}  // namespace barchan
