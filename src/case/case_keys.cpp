#include "src/case/case_keys.hpp"

#include "src/case/case_values.hpp"
#include "src/toml/key_builder.hpp"

namespace barchan {
namespace {

/// Key that is used before any other is read (bases.cpp).
Key read_first(const char* name, const char* meaning) {
  return {
      .section = "case",
      .name = name,
      .type = "text, or array of them",
      .form = {.of = Form::Of::any_of,
               .parts = {{Form::Of::text}, {.of = Form::Of::list, .parts = {{Form::Of::text}}}}},
      .range = any,
      .unit = "",
      .meaning = meaning,
      .read = [](const Node&, Config&, std::size_t) { return Mismatch(); },
      .text = [](const Config&, std::size_t) { return std::optional<std::string>(); }};
}

}  // namespace

void add_case(Sections& all) {
  Section& section = add(all, "case", "What the run is called, and what it is based on");
  Keys key(section, [](auto& c) { return &c; });
  key("title", &Config::title, at_most(200), "", "one line for tables, pages and pictures");
  key("notes", &Config::notes, at_most(2000), "",
      "free text, kept with every result: who ran the case and why");
  section.keys.push_back(read_first(
      "base",
      "case whose keys this one takes over and may give other values; of several the later ones "
      "win; lists, as `[[body]]`, are replaced whole"));
  section.keys.push_back(read_first(
      "without", "sections and keys of the base, as \"grains.feed\", that are left out"));
}

void add_time(Sections& all) {
  Keys key(add(all, "time", "End and steps"), [](auto& c) { return &c.time; });
  key("end", &TimeConfig::end, above(0), "s", "time at which the run ends", required);
  key("fluid_step", &TimeConfig::fluid_step, between(1e-15, 1), "s",
      "step of the flow; without `[fluid]` the interval between checks and output; \"auto\": by "
      "the "
      "CFL number",
      fixed_by_restart)
      .by_default = kAutomatic;
  key("grain_step", &TimeConfig::grain_step, between(1e-18, 1), "s",
      "longest step of the grains; a fluid step is divided into equal grain steps; \"auto\": by "
      "the "
      "stable step of contacts")
      .by_default = kAutomatic;
  key("wall_clock_limit", &TimeConfig::wall_clock_limit, at_least(0), "s",
      "wall time after which a restart file is written and the run stops (exit code 3); 0: none");
}

}  // namespace barchan
