// The `check` command.
#pragma once

#include <ostream>

#include "src/run/command_line.hpp"

namespace barchan {

/// Writes the resolved configuration, its derived numbers and its warnings to `out`, the first
/// alone with --resolved-only; returns the exit code 0. Throws ConfigError when the case is not
/// valid.
int run_check(const CommandLine& line, std::ostream& out);

}  // namespace barchan
