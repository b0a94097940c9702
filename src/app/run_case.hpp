// Command run.
#pragma once

#include "src/app/command_line.hpp"

namespace barchan {

/// Runs a case from its configuration to its results, with the cases it starts from. Returns the
/// exit code: 0 done, 3 stopped on request. Throws ConfigError (exit code 2) and std::runtime_error
/// (exit code 1).
int run_command(const CommandLine& line);

}  // namespace barchan
