// Short ways to ask what is wrong with a configuration.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/case/load.hpp"

namespace barchan::test {

/// A grains-only case in nine lines; `grains` follows as line 10 and on.
inline std::string grain_case(const std::string& grains = "") {
  return "[time]\nend = 1.0\n[domain]\nsize = [0.1, 0.025, 0.04]\n[initial]\n"
         "grains = { pour = { centre = [0.05, 0.02], radius = 0.006 } }\n\n[grains]\n"
         "sizes = [[0.2e-3, 100]]\n" +
         grains;
}

/// A fluid-only case in six lines; `fluid` follows as line 7 and on.
inline std::string fluid_case(const std::string& fluid = "",
                              const std::string& cells = "[62, 30, 25]") {
  return "[time]\nend = 1.0\n[domain]\nsize = [0.1, 0.025, 0.04]\n[fluid]\ncells = " + cells +
         "\n" + fluid;
}

/// A case with both parts whose cells and steps nothing is said against, with grains of 0.2 mm.
inline std::string coupled_case(const std::string& sizes = "[[0.2e-3, 100]]") {
  return fluid_case("first_cell_height = 1.6e-4\nmean_velocity = 0.28\n[grains]\nsizes = " + sizes +
                        "\n[initial]\nfluid = \"turbulent\"\ngrains = { pour = { centre = [0.05, "
                        "0.02], radius = 0.006 } }\n",
                    "[96, 30, 25]");
}

using Lines = std::vector<std::string>;

/// The lines a case is refused with when `load` is called, or none when it loads.
template <class Load>
Lines lines_of(const Load& load) {
  try {
    load();
  } catch (const ConfigError& error) {
    return error.lines();
  }
  return {};
}

inline Lines problems(const std::string& text, const Lines& overrides = {}) {
  return lines_of([&] { load_config_text(text, "case.toml", overrides); });
}

/// Result of `problems` for a single one.
inline Lines only(const std::string& line) { return {line, "1 problem; nothing was run."}; }

/// Expects that a case is refused for one problem, told by `line`.
inline void refused(const std::string& text, const std::string& line, const Lines& overrides = {}) {
  EXPECT_EQ(problems(text, overrides), only(line));
}

/// Expects that a case is refused for `line`, the last of its [grains] or [fluid], and why.
inline void refused_grains(const std::string& line, const std::string& why) {
  refused(grain_case(line + "\n"), "case.toml:10: [grains] " + line + ": " + why);
}
inline void refused_fluid(const std::string& line, const std::string& why) {
  refused(fluid_case(line + "\n"), "case.toml:7: [fluid] " + line + ": " + why);
}

}  // namespace barchan::test
