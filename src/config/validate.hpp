// Checks between keys: what is contradictory (an error) and what is unwise (a warning).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "src/config/config.hpp"
#include "src/config/derived.hpp"

namespace barchan {

/// Dotted `keys` the finding rests on, the one to point at first; `message` follows
/// "[section] key = value: ".
struct Finding {
  enum class Severity { error, warning } severity;
  std::vector<std::string> keys;
  std::string message;
};

/// Everything found. `sizes`: of the grains when known (known_sizes); with none, what depends on
/// grain size is not checked: call check_grain_sizes once the grains are there.
std::vector<Finding> validate(const Config& config, const std::vector<SizeClass>& sizes);

/// Only what depends on the sizes: the grain step against the Rayleigh time, cells against grains.
std::vector<Finding> check_grain_sizes(const Config& config, const std::vector<SizeClass>& sizes);

/// What does not fit between a case and the case whose end it starts from. `flow`: the start is
/// that of the fluid (initial.fluid), else of the grains (initial.grains).
std::vector<Finding> check_start(const Config& config, const Config& start, bool flow);

/// The warnings of `validate`, one line each: "warning: [section] key: message".
std::vector<std::string> config_warnings(const Config& config, const std::vector<SizeClass>& sizes);

// What these checks are made of.

using Keys = std::vector<std::string>;

struct Findings {
  std::vector<Finding> all;

  /// Adds a finding if a condition holds, and says whether it does.
  template <class... Args>
  bool error_if(bool wrong, const Keys& keys, fmt::format_string<Args...> message, Args&&... args) {
    using enum Finding::Severity;
    if (wrong) all.push_back({error, keys, fmt::format(message, std::forward<Args>(args)...)});
    return wrong;
  }
  template <class... Args>
  bool warning_if(bool unwise, const Keys& keys, fmt::format_string<Args...> message,
                  Args&&... args) {
    using enum Finding::Severity;
    if (unwise) all.push_back({warning, keys, fmt::format(message, std::forward<Args>(args)...)});
    return unwise;
  }
  /// Adds an error if `value` is above `most`, a warning if only above `wise`; true for an error.
  bool limit(double value, double wise, double most, const Keys& keys, const std::string& error,
             const std::string& warning) {
    if (error_if(value > most, keys, "{}", error)) return true;
    warning_if(value > wise, keys, "{}", warning);
    return false;
  }
};

/// Keys that were changed and can do nothing.
void check_effects(const Config& config, Findings& found);

/// [grains] and its cone against each other and against the fluid. `config` has the section.
void check_grains(const Config& config, Findings& found);

}  // namespace barchan
