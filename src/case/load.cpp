#include "src/case/load.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "src/base/atomic_file.hpp"
#include "src/base/words.hpp"
#include "src/case/derived.hpp"
#include "src/case/heaps.hpp"
#include "src/case/steps.hpp"
#include "src/case/validate.hpp"
#include "src/grains/kinds.hpp"
#include "src/toml/case_text.hpp"
#include "src/toml/lengths.hpp"
#include "src/toml/reading.hpp"

namespace barchan {
namespace fs = std::filesystem;
namespace {

bool is_case(const fs::path& start) { return start.extension() == ".toml"; }

/// Checks a start `key` that is a file: its kind is known, and it is there. Makes its path
/// absolute.
void resolve_start(ConfigReader& reading, const std::string& key, fs::path& start) {
  const bool flow = key == "initial.fluid";
  const Node* node = reading.tree().find(key);
  if (node == nullptr || node->table() != nullptr || reading.is_bad(key)) return;
  if (flow && std::ranges::count(StartFlows::words, start.string()) > 0) return;
  if (start.extension() != ".h5" && start.extension() != ".toml" &&
      (flow || start.extension() != ".csv")) {
    return reading.report_error(
        key, flow ? fmt::format("must be \"{}\" or a file ending in .h5, .toml",
                                fmt::join(StartFlows::words, "\", \""))
                  : "must be a file ending in .csv, .h5, .toml, or { pour = {...} }");
  }
  const fs::path path = fs::absolute(reading.folder_of(key) / start).lexically_normal();
  std::error_code ignored;
  if (const std::string why = not_a_file(path); why.empty()) {
    start = path;
  } else if (fs::exists(path, ignored) || fs::is_symlink(path, ignored)) {
    reading.report_error(key, fmt::format("must be a file to read: {}: {}", path.string(), why));
  } else {
    reading.report_error(key, fmt::format("must be a file that exists; there is no {}{}",
                                          path.string(), nearest_file(path)));
  }
}

Config as_read(ConfigReader& reading, const fs::path& file) {
  Config config;
  config.file = file;
  reading.read(config);
  return config;
}

struct Loaded {
  Case result;
  std::vector<Problem> problems;  // problems of this file, then of those it starts from
};

/// Context of a load: the cases that lead to it, and how to read grains from a file.
struct Context {
  SizesInFile sizes_in;
  std::vector<fs::path> chain = {};
};

Loaded load(std::string_view text, const fs::path& file, const std::vector<std::string>& overrides,
            const Context& context);

/// Reports errors in values that were read. An error that rests on a value read wrongly would only
/// confuse.
void report(const std::vector<Finding>& findings, ConfigReader& reading) {
  for (const Finding& finding : findings) {
    const bool doubtful = std::any_of(finding.keys.begin(), finding.keys.end(),
                                      [&](const std::string& key) { return reading.is_bad(key); });
    if (finding.severity == Finding::Severity::error && !doubtful) {
      reading.report_conflict(finding.keys.front(), finding.message);
    }
  }
}

/// Loads the case that the start `key` names, if it names one.
Loaded load_start(const Config& config, const std::string& key, const fs::path& start,
                  ConfigReader& reading, Context context) {
  Loaded loaded;
  if (!is_case(start) || reading.is_bad(key)) return loaded;
  std::vector<fs::path>& chain = context.chain;
  chain.push_back(fs::weakly_canonical(config.file));
  if (std::find(chain.begin(), chain.end(), fs::weakly_canonical(start)) != chain.end()) {
    reading.report_conflict(key, "must not lead back to this case");
    return loaded;
  }
  if (const auto text = case_text(start, loaded.problems)) loaded = load(*text, start, {}, context);
  return loaded;
}

/// Cases that a case starts from.
struct Starts {
  Loaded flow, grains;
  std::vector<Problem> problems;  // problems of both
};

Starts load_starts(Config& config, ConfigReader& reading, const Context& context) {
  InitialConfig& initial = config.initial;
  resolve_start(reading, "initial.fluid", initial.fluid);
  resolve_start(reading, "initial.grains", initial.grains);
  Starts starts;
  starts.flow = load_start(config, "initial.fluid", initial.fluid, reading, context);
  starts.problems = starts.flow.problems;
  if (initial.fluid == initial.grains && !reading.is_bad("initial.fluid")) {
    starts.grains.result = starts.flow.result;  // its problems are reported there
  } else {
    starts.grains = load_start(config, "initial.grains", initial.grains, reading, context);
    std::ranges::copy(starts.grains.problems, std::back_inserter(starts.problems));
  }
  return starts;
}

/// Sizes of the grains of a start; empty if it has none, or they are not known.
std::vector<SizeClass> sizes_of_start(const Config& config, const Starts& starts,
                                      const ConfigReader& reading, const SizesInFile& sizes_in) {
  if (!config.grains || reading.is_bad("initial.grains")) return {};
  const Case& start = starts.grains.result;
  if (start.config.grains) return with_kinds_of(*config.grains, *start.config.grains, start.sizes);
  const fs::path& file = config.initial.grains;
  if (!sizes_in || file.empty() || is_case(file)) return {};
  try {
    return sizes_in(config, file);
  } catch (const InputError&) {
    return {};  // reported where the grains are read
  }
}

/// Gives values to the keys that depend on the grains. `sizes`: of the grains that are poured, here
/// or in the case that this one starts from. For other grains, [grains] sizes need not be true.
void settle(ConfigReader& reading, Config& config, const std::vector<SizeClass>& sizes, bool tell) {
  // The diameter d of a case is rounded, so that a few grains more or less have the same mesh.
  reading.settle_lengths(config, sizes.empty() ? 0 : rounded(mean_diameter(sizes), 3), tell);
  std::optional<HeapConfig>& pour = config.initial.pour;
  if (pour && pour->shape != HeapShape::bed && !reading.tree().find("initial.grains.pour.centre"))
    pour->centre = {config.size[0] / 5, config.size[2] / 2};
  if (reading.is_automatic("time.fluid_step") && !reading.is_bad("fluid"))
    config.time.fluid_step = chosen_fluid_step(config, sizes);
  if (reading.is_automatic("time.grain_step"))
    config.time.grain_step = chosen_grain_step(config, sizes);
}

/// Reads a file, its bases and the assignments, and checks it against its starts.
void read_case(ConfigReader& reading, const fs::path& file, const Context& context,
               Loaded& loaded) {
  Case& result = loaded.result;
  Config& config = result.config = as_read(reading, file);
  Starts starts = load_starts(config, reading, context);
  const std::vector<HeapConfig> heaps = poured_heaps(config);
  result.random =
      (config.fluid && (config.initial.starts_as<TurbulentFlow>() || starts.flow.result.random)) ||
      (config.grains && (!heaps.empty() || starts.grains.result.random));
  if (config.initial.realisation > 1 && !result.random && starts.problems.empty()) {
    reading.report_conflict("initial.realisation",
                            "has other random numbers, and this case starts from none: its "
                            "realisations would all be the same");
  }
  if (config.grains) result.sizes = heaps.empty() ? poured_sizes(*config.grains) : sizes_of(heaps);
  const std::vector<SizeClass> of_start = sizes_of_start(config, starts, reading, context.sizes_in);
  settle(reading, config, heaps.empty() ? of_start : result.sizes, starts.problems.empty());
  if (result.sizes.empty() && starts.grains.result.config.grains) result.sizes = of_start;
  if (starts.problems.empty()) {
    const auto check = [&](const Config& start, bool flow) {
      if (!start.file.empty()) report(check_start(config, start, flow), reading);
    };
    check(starts.flow.result.config, true);
    check(starts.grains.result.config, false);
  }
  report(validate(config, result.sizes), reading);
  if (is_case(config.initial.fluid))
    result.flow_start = std::make_shared<const Case>(std::move(starts.flow.result));
  if (is_case(config.initial.grains))
    result.grain_start = std::make_shared<const Case>(std::move(starts.grains.result));
  loaded.problems = std::move(starts.problems);
  if (loaded.problems.empty() && reading.problems().empty()) result.settle();
}

Loaded load(std::string_view text, const fs::path& file, const std::vector<std::string>& overrides,
            const Context& context) {
  Loaded loaded;
  ConfigReader reading(text, file);
  bool parsed = reading.problems().empty();
  if (const Node* study = reading.tree().find("study"); study != nullptr && study->table()) {
    loaded.problems.push_back(
        {study->where, "[study]: this is a study, not a case: ./barchan sweep " + file.string()});
    return loaded;
  }
  if (parsed) reading.inherit();
  parsed = reading.problems().empty();
  reading.set(overrides);
  if (parsed) reading.renew_old_keys();
  if (parsed) reading.drop_switched_off();
  if (parsed) read_case(reading, file, context, loaded);
  for (const auto& [where, notice] : reading.notices())
    loaded.result.notices.push_back(fmt::format("{}: {}", to_string(where), notice));
  const auto by_line = [](const Problem& a, const Problem& b) {
    return unsigned(a.where.line) - 1 < unsigned(b.where.line) - 1;  // no line: last
  };
  std::vector<Problem>& own = reading.problems();
  std::stable_sort(own.begin(), own.end(), by_line);
  loaded.problems.insert(loaded.problems.begin(), own.begin(), own.end());
  return loaded;
}

/// Throws if there is any problem.
Case checked(Loaded loaded) {
  if (loaded.problems.empty()) return std::move(loaded.result);
  // a file that is no case at all may have any number of problems
  constexpr std::size_t max_told = 30;
  const std::size_t count = loaded.problems.size();
  std::vector<std::string> lines;
  for (const Problem& problem : loaded.problems) {
    if (lines.size() == max_told) break;
    lines.push_back(printable(fmt::format("{}: {}", to_string(problem.where), problem.text)));
  }
  if (count > lines.size()) lines.push_back(fmt::format("  ... and {} more", count - lines.size()));
  lines.push_back(fmt::format("{} problem{}; nothing was run.", count, count == 1 ? "" : "s"));
  throw ConfigError(std::move(lines));
}

}  // namespace

Case load_case(const fs::path& file, const std::vector<std::string>& overrides,
               const SizesInFile& sizes_in) {
  Loaded nothing;
  const auto text = case_text(file, nothing.problems);
  return checked(text ? load(*text, file, overrides, {sizes_in}) : std::move(nothing));
}

Case load_case_text(std::string_view text, const fs::path& file,
                    const std::vector<std::string>& overrides) {
  return checked(load(text, file, overrides, {}));
}

std::vector<std::string> case_warnings(const Case& the_case, const std::vector<SizeClass>& sizes) {
  std::vector<std::string> lines = the_case.notices;
  std::ranges::copy(config_warnings(the_case.config, sizes), std::back_inserter(lines));
  return lines;
}

Config load_config(const fs::path& file, const std::vector<std::string>& overrides) {
  return load_case(file, overrides).config;
}

Config load_config_text(std::string_view text, const fs::path& file,
                        const std::vector<std::string>& overrides) {
  return load_case_text(text, file, overrides).config;
}

Config config_as_written(std::string_view resolved, const fs::path& file) {
  ConfigReader reading(resolved, file);
  reading.renew_old_keys();
  return as_read(reading, file);
}

bool says(std::string_view resolved, const Config& config) {
  ConfigReader reading(resolved, config.file);
  reading.renew_old_keys();
  return as_read(reading, config.file) == config && !reading.has_bad_keys();
}

bool is_written_in(const fs::path& file, const Config& config) {
  std::vector<Problem> unreadable;
  const auto text = case_text(file, unreadable);
  return text && says(*text, config);
}

}  // namespace barchan
