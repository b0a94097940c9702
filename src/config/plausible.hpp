// Values that are numbers and in range, but that nobody means.
#pragma once

#include <vector>

#include "src/config/config.hpp"
#include "src/config/findings.hpp"

namespace barchan {

/// Errors for values so large or small that what follows from them overflows, or that cannot be
/// counted. Wide on purpose: what is merely unusual is the user's business.
std::vector<Finding> implausible(const Config& config);

}  // namespace barchan
