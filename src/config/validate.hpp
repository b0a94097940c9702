// Checks between keys: what is contradictory (an error) and what is unwise (a warning).
#pragma once

#include <string>
#include <vector>

#include "src/config/config.hpp"
#include "src/config/findings.hpp"

namespace barchan {

/// Everything found. `sizes`: of the grains when known (known_sizes); with none, what depends on
/// grain size is not checked: call check_grain_sizes once the grains are there.
std::vector<Finding> validate(const Config& config, const std::vector<SizeClass>& sizes);

/// Only what depends on the sizes: the grain step against the Rayleigh time, cells against grains.
std::vector<Finding> check_grain_sizes(const Config& config, const std::vector<SizeClass>& sizes);

/// The warnings of `validate`, one line each: "warning: [section] key: message".
std::vector<std::string> config_warnings(const Config& config, const std::vector<SizeClass>& sizes);

}  // namespace barchan
