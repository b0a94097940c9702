#include "src/toml/keys_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/errors.hpp"
#include "src/base/words.hpp"

namespace barchan {
namespace {

/// Domain of a key: type, choices or range, as in "number, above 0 and at most 1".
std::string domain_of(const Key& key) {
  const std::string range = key.range.text();
  if (range.empty()) return key.type;
  return fmt::format("{}, {}{}", key.type, range, key.type == "text" ? " bytes" : "");
}

/// Domain of a key in a table, with the unit: "number, 0 to 1 [m]".
std::string domain_in_table(const Key& key) {
  const Range& range = key.range;
  const bool both = range.min > -Range::infinite && range.max < Range::infinite &&
                    !range.above_min && !range.below_max;
  const std::string text =
      both ? fmt::format("{}, {:g} to {:g}", key.type, range.min, range.max) : domain_of(key);
  return key.unit.empty() ? text : fmt::format("{} [{}]", text, key.unit);
}

/// Default in words: "required", "none", "as in `[grains]`" or the value in backticks.
std::string default_of(const Section& section, const Key& key, const Config& defaults) {
  if (key.required) return "required";
  if (key.by_default == kNoDefault) return "none";
  if (!section.like.empty() && key.by_default.empty())
    return fmt::format("as in `[{}]`", section.like);
  if (key.by_default.starts_with('[')) return fmt::format("`{}`", key.by_default);
  if (!key.by_default.empty()) return fmt::format("`\"{}\"`", key.by_default);
  const std::string value = key.text(defaults, 0).value_or("");
  const bool none = value.empty() || value == "\"\"" || value == "[]";
  return none ? "none" : "`" + value + "`";
}

std::string row(const Section& section, const Key& key, const Config& defaults) {
  return fmt::format("| `{}` | {} | {} | {}{} |\n", key.name, domain_in_table(key),
                     default_of(section, key, defaults), key.meaning,
                     key.fixed_by_restart ? " (R)" : "");
}

/// Text in lines of at most 100 characters, all but the first indented.
std::string wrapped(std::string_view text, std::size_t indent) {
  constexpr std::size_t kWidth = 100;
  std::string lines;
  std::size_t at = indent;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (at > indent && at + 1 + end > kWidth) {
      lines += '\n' + std::string(indent, ' ');
      at = indent;
    } else if (at > indent) {
      lines += ' ';
      ++at;
    }
    lines += text.substr(0, end);
    at += end;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines + '\n';
}

/// Entry of a key: two paragraphs beside the name, its meaning and its domain.
std::string entry(const Section& section, const Key& key, const Config& defaults,
                  std::size_t width) {
  const std::size_t indent = width + 4;
  const std::string unit = key.unit.empty() ? "" : fmt::format(" [{}]", key.unit);
  std::string text =
      fmt::format("  {:<{}}  {}", key.name, width, wrapped(key.meaning, indent)) +
      std::string(indent, ' ') +
      wrapped(fmt::format("{}{}; {}{}", domain_of(key), unit, key.required ? "" : "default ",
                          default_of(section, key, defaults)),
              indent);
  if (key.fixed_by_restart)
    text += std::string(indent, ' ') + "the same after a restart as before it\n";
  std::erase(text, '`');
  return text;
}

[[noreturn]] void refuse(const std::string& name, const Sections& table) {
  std::vector<std::string> names, keys;
  for (const Section& section : table) {
    if (!section.keys.empty()) names.push_back(section.name);
    for (const Key& key : section.keys) keys.push_back(key.dotted());
  }
  const std::string close = nearest(name, name.find('.') == name.npos ? names : keys);
  throw InputError(fmt::format("unknown section \"{}\"{}; there are {}", name, did_you_mean(close),
                               fmt::join(names, ", ")));
}

}  // namespace

std::string title_of(const Section& section) {
  return section.repeated() ? fmt::format("[[{}]]", section.name)
                            : fmt::format("[{}]", section.name);
}

std::shared_ptr<const Config> with_every_section(const Sections& table) {
  const std::shared_ptr<Config> defaults = blank_config();
  for (const Section& section : table) {
    if (section.repeated()) section.append(*defaults);
    if (section.prepare) section.prepare(*defaults, true);
  }
  return defaults;
}

std::string keys_page(const Sections& table) {
  std::string page =
      "# Keys of a case\n\n"
      "Printed by `./barchan keys`. Numbers are in SI units. A length may also be a text: `\"0.2 "
      "mm\"` (m, cm, mm, um), or\n`\"3 d\"` in mean diameters, by number, of the grains that the "
      "case starts with; `check --resolved` prints it in\nmetres. Only the diameters themselves, "
      "`sizes`, are never in d. `--set section.key=value` changes a key for one run.\nKeys marked "
      "(R) stay as they are in a restart. Numbers within these ranges may still be refused if they "
      "do not fit\nother keys.\n";
  const auto defaults = with_every_section(table);
  for (const Section& section : table) {
    if (section.keys.empty()) continue;
    page += fmt::format("\n## {}\n\n{}{}.\n\n", title_of(section), section.meaning,
                        section.required ? " (required)" : "");
    page += "| key | type, range, unit | default | meaning |\n|---|---|---|---|\n";
    for (const Key& key : section.keys) page += row(section, key, *defaults);
  }
  return page;
}

std::string keys_text(std::string_view name, const Sections& table) {
  const std::string inner = fmt::format(".{}", name);  // "pour" is enough
  const bool is_section = std::ranges::any_of(table, [&](const Section& section) {
    return !section.keys.empty() && (section.name == name || section.name.ends_with(inner));
  });
  const auto defaults = with_every_section(table);
  std::string text;
  for (const Section& section : table) {
    std::size_t width = 0;
    for (const Key& key : section.keys) width = std::max(width, key.name.size());
    const bool whole = section.name == name || section.name.ends_with(inner);
    std::string entries;
    for (const Key& key : section.keys) {
      if (whole || key.dotted() == name || (key.name == name && !is_section))
        entries += entry(section, key, *defaults, width);
    }
    if (entries.empty()) continue;
    std::string head = wrapped(section.meaning + (section.required ? " (required)." : "."), 0);
    std::erase(head, '`');
    text += fmt::format("{}{}\n{}\n{}", text.empty() ? "" : "\n", title_of(section), head, entries);
    if (whole) break;
  }
  if (text.empty()) refuse(std::string(name), table);
  return text;
}

}  // namespace barchan
