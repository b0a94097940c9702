#include "src/case/resolved.hpp"

#include <fmt/ranges.h>

#include <optional>

#include "src/case/config.hpp"
#include "src/toml/keys_page.hpp"

namespace barchan {
namespace {

/// Value of a key; of a section that is there many times, those of all of them.
std::optional<std::string> text_of(const Section& section, const Key& key, const Config& config) {
  if (!section.repeated()) return key.text(config, 0);
  std::vector<std::string> texts;
  for (std::size_t n = 0; n < section.count(config); ++n)
    texts.push_back(key.text(config, n).value_or("absent"));
  if (texts.empty()) return {};
  return fmt::format("{}", fmt::join(texts, ", "));
}

struct Difference {
  const Key* key;
  std::string here, there;
};

/// Keys in which two cases differ.
std::vector<Difference> differences(const Config& a, const Config& b, const Sections& table,
                                    bool fixed_by_restart) {
  std::vector<Difference> found;
  for (const Section& section : table) {
    for (const Key& key : section.keys) {
      const auto here = text_of(section, key, a), there = text_of(section, key, b);
      if (key.fixed_by_restart != fixed_by_restart || here == there) continue;
      found.push_back({&key, here.value_or("absent"), there.value_or("absent")});
    }
  }
  return found;
}

/// Checks that probes keep their numbers: rows of probes.csv name them by these.
void check_probes_kept(const Config& config, const Config& written,
                       std::vector<std::string>& conflicts) {
  const std::vector<ProbeConfig>& here = config.output.probes;
  for (std::size_t n = 0; n < written.output.probes.size(); ++n) {
    ProbeConfig there = written.output.probes[n];
    if (n < here.size()) there.interval = here[n].interval;
    if (n < here.size() && here[n] == there) continue;
    conflicts.push_back(fmt::format(
        "[[output.probe]] {}: it was written with the probe \"{}\" there; keep it as it "
        "was, and put new ones after it",
        n + 1, there.name));
  }
}

}  // namespace

std::string to_toml(const Config& config, const Sections& table) {
  std::string text;
  const auto add = [&](const Section& section, const std::string& title, std::size_t entry) {
    std::string lines;
    for (const Key& key : section.keys) {
      if (const auto value = key.text(config, entry))
        lines += fmt::format("{} = {}\n", key.name, *value);
    }
    if (!lines.empty()) text += fmt::format("{}{}\n{}", text.empty() ? "" : "\n", title, lines);
  };
  for (const Section& section : table) {
    if (section.repeated()) {
      for (std::size_t n = 0; n < section.count(config); ++n) add(section, title_of(section), n);
    } else {
      add(section, title_of(section), 0);
    }
  }
  return text;
}

std::vector<std::string> restart_conflicts(const Config& config, const Config& written,
                                           const Sections& table) {
  std::vector<std::string> conflicts;
  const auto section = [&](const char* name, bool here, bool there) {
    if (here == there) return;
    conflicts.push_back(
        fmt::format("{}: it was written by a case with{} this section", name, there ? "" : "out"));
  };
  section("[fluid]", config.fluid.has_value(), written.fluid.has_value());
  section("[grains]", config.grains.has_value(), written.grains.has_value());
  if (!conflicts.empty()) return conflicts;
  check_probes_kept(config, written, conflicts);
  for (const auto& [key, here, there] : differences(config, written, table, true))
    conflicts.push_back(fmt::format("{} = {}: it was written with {}", key->dotted(), here, there));
  return conflicts;
}

std::vector<std::string> changed_keys(const Config& config, const Config& written,
                                      const Sections& table) {
  std::vector<std::string> keys;
  for (const auto& [key, here, there] : differences(config, written, table, false))
    keys.push_back(fmt::format("{} {} -> {}", key->dotted(), there, here));
  return keys;
}

}  // namespace barchan
