// Checks between keys: what is contradictory (an error) and what is unwise (a warning).
#pragma once

#include <string>
#include <vector>

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Everything found. `sizes`: of the grains when known (Case::sizes); with none, what depends on
/// grain size is not checked: call check_grain_sizes once the grains are there.
std::vector<Finding> validate(const Config& config, const std::vector<SizeClass>& sizes);

/// What does not fit between a case and the case whose end it starts from. `flow`: the start is
/// that of the fluid (initial.fluid), else of the grains (initial.grains).
std::vector<Finding> check_start(const Config& config, const Config& start, bool flow);

/// The warnings of `validate`, one line each: "[section] key message".
std::vector<std::string> config_warnings(const Config& config, const std::vector<SizeClass>& sizes);

}  // namespace barchan
