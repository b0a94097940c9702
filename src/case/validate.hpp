// Checks between keys: what is contradictory (an error) and what is unwise (a warning).
#pragma once

#include <string>
#include <vector>

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Findings of all checks of a case. `sizes`: of the grains when known (Case::sizes). Without
/// sizes, checks that depend on them are left out: call check_grain_sizes once the grains are
/// there.
std::vector<Finding> validate(const Config& config, const std::vector<SizeClass>& sizes);

/// Findings about a case and the case whose end it starts from. `flow`: the start is that of the
/// fluid (initial.fluid), else of the grains (initial.grains).
std::vector<Finding> check_start(const Config& config, const Config& start, bool flow);

/// Warnings of `validate`, one line each: "[section] key message".
std::vector<std::string> config_warnings(const Config& config, const std::vector<SizeClass>& sizes);

}  // namespace barchan
