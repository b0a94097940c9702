#include "src/app/starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "src/base/errors.hpp"
#include "src/base/words.hpp"
#include "src/case/ensemble_member.hpp"
#include "src/case/heaps.hpp"
#include "src/case/resolved.hpp"
#include "src/diagnostics/probes.hpp"
#include "src/fluid/passage.hpp"
#include "src/grains/kinds.hpp"
#include "src/initial/grain_files.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/overlaps.hpp"
#include "src/io/seal.hpp"
#include "src/run/case_inputs.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

std::vector<SizeClass> sizes_of(const InitialGrains& grains) {
  std::map<std::pair<double, int>, std::int64_t> count;
  for (std::size_t g = 0; g < grains.size(); ++g) ++count[{grains.diameter[g], grains.kind_of(g)}];
  std::vector<SizeClass> sizes;
  for (const auto& [of, n] : count)
    sizes.push_back({.diameter = of.first, .count = n, .kind = of.second});
  return sizes;
}

void add_missing(const Case& the_case, const fs::path& folder, std::vector<StartCase>& missing) {
  const Config& config = the_case.config;
  const fs::path runs = folder_of_runs(config.file, folder);
  const auto add = [&](const std::shared_ptr<const Case>& source) {
    if (!source) return;
    StartCase start = start_case(*source, runs, config.initial.realisation);
    const bool known = std::ranges::any_of(
        missing, [&](const StartCase& other) { return other.folder == start.folder; });
    if (known || start.earlier.done()) return;
    if (!start.earlier.same()) add_missing(start.realised, start.folder, missing);
    missing.push_back(std::move(start));
  };
  if (config.fluid) add(the_case.flow_start);
  if (config.grains) add(the_case.grain_start);
}

PlannedGrains grains_in(const fs::path& file, const SettledCase& the_case) {
  PlannedGrains planned;
  planned.grains = as_input([&] { return checked_grains(the_case, file); });
  planned.settled.sizes = sizes_of(*planned.grains);
  planned.source = file;
  return planned;
}

}  // namespace

std::string shown(const fs::path& folder) {
  const fs::path near = fs::absolute(folder).lexically_proximate(fs::current_path());
  return near.empty() || *near.begin() == ".." ? folder.string() : near.string();
}

Case load_case_of(const CommandLine& line) {
  // Sizes are read without checked_grains: the box of the case may be given in their diameters.
  return load_case(line.file, line.overrides, [](const Config& config, const fs::path& file) {
    InitialGrains grains = as_input([&] { return read_grains(file); });
    take_kinds(grains, *config.grains, file.string());
    return sizes_of(grains);
  });
}

StartCase start_case(const Case& source, const fs::path& runs, int realisation) {
  StartCase start{.realised = ensemble_member(source, realisation), .folder = {}, .earlier = {}};
  const bool same = start.realised.config == source.config;
  const std::string other = same ? "" : fmt::format("-r{}", realisation);
  start.folder = runs / case_name(source.config.file);
  start.folder += other;
  start.earlier = earlier_run(start.realised, start.folder);
  return start;
}

nlohmann::json inputs_to_record(const Case& the_case, const fs::path& folder) {
  nlohmann::json inputs;
  const fs::path runs = folder_of_runs(the_case.config.file, folder);
  for (const auto& [key, file, source] : inputs_of(the_case)) {
    if (!source) {
      inputs[key] = content_key(file);
      continue;
    }
    const StartCase start = start_case(*source, runs, the_case.config.initial.realisation);
    inputs[key] = recorded_inputs(start.folder);
    if (!inputs[key].is_object()) inputs[key] = inputs_to_record(start.realised, start.folder);
    inputs[key]["config"] = to_toml(start.realised.config);
  }
  return inputs;
}

std::vector<StartCase> missing_starts(const Case& the_case, const fs::path& folder) {
  std::vector<StartCase> missing;
  add_missing(the_case, folder, missing);
  return missing;
}

void check_earlier_places(const Case& the_case, const fs::path& folder) {
  if (earlier_run(the_case, folder).done()) return;
  const fs::path runs = folder_of_runs(the_case.config.file, folder);
  std::string moves;
  const auto look = [&](const Case& one, const fs::path& now) {
    const fs::path before = runs / now.filename();
    if (fs::exists(now) || !earlier_run(one, before).done()) return;
    moves += fmt::format("\n  mkdir -p {}; mv {} {}", shown(now.parent_path()), shown(before),
                         shown(now));
  };
  if (fs::absolute(folder) == runs / case_name(the_case.config.file)) look(the_case, folder);
  if (moves.empty()) {
    for (const StartCase& start : missing_starts(the_case, folder))
      look(start.realised, start.folder);
  }
  if (moves.empty()) return;
  throw InputError(
      "results of an earlier version have another folder now; move them, or compute them again "
      "with --overwrite:" +
      moves);
}

namespace {

/// Highest point of the grains that a run starts with [m], before they settle where they are still
/// to be poured; 0 without grains.
double top_of(const PlannedGrains& planned, const Config& config) {
  if (!planned.grains) return poured_top(planned.poured_in.heaps, planned.poured_in.config.size);
  const InitialGrains spheres = spheres_at_start(*planned.grains, config);
  double top = 0;
  for (std::size_t s = 0; s < spheres.size(); ++s)
    top = std::max(top, spheres.x[s].y + spheres.diameter[s] / 2);
  return top;
}

/// Grains that a run starts with, before its feed is looked at.
PlannedGrains grains_of(const Case& the_case, const fs::path& folder) {
  const Config& config = the_case.config;
  if (config.fluid) check_passage(the_case.fluid());
  check_probes(the_case);
  if (!config.grains) return {};
  if (!the_case.heaps.empty()) {
    PlannedGrains planned;
    planned.settled.sizes = sizes_of(the_case.heaps);
    planned.poured_in = the_case;
    planned.source = config.file;
    return planned;
  }
  const fs::path& source = config.initial.grains;
  if (!the_case.grain_start) return grains_in(source, the_case);
  const StartCase start = start_case(*the_case.grain_start, folder_of_runs(config.file, folder),
                                     config.initial.realisation);
  if (start.earlier.done()) return grains_in(*start.earlier.restart, the_case);
  PlannedGrains planned = planned_grains(start.realised, start.folder);
  std::vector<SizeClass>& sizes = planned.settled.sizes;
  sizes = with_kinds_of(*config.grains, *start.realised.config.grains, std::move(sizes));
  if (planned.grains) {
    planned.grains->kind_names = names_of_kinds(*start.realised.config.grains);
    planned.grains->shapes.clear();  // load_case() has compared them
    take_kinds(*planned.grains, *config.grains, source.string());
  }
  check_sizes(sizes, config, source);
  return planned;
}

}  // namespace

PlannedGrains planned_grains(const Case& the_case, const fs::path& folder) {
  PlannedGrains planned = grains_of(the_case, folder);
  planned.settled =
      SettledCase(the_case.config, planned.settled.sizes, top_of(planned, the_case.config));
  const std::vector<SizeClass>& sizes = planned.settled.sizes;
  if (sizes.empty()) return planned;
  planned.settled.numbers.grains->as_poured = !planned.grains;
  check_feed_places(the_case.grains(), widths_of(*the_case.config.grains, sizes));
  return planned;
}

}  // namespace barchan
