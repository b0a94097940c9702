// The command check.
#pragma once

#include <iosfwd>

#include "src/app/command_line.hpp"

namespace barchan {

/// Writes the resolved configuration, its derived numbers, what it will cost and its warnings to
/// `out`, the first alone with --resolved-only (and then Kokkos need not run); returns the exit
/// code 0. Throws ConfigError when the case is not valid, InputError when its grains do not suit
/// it.
int run_check(const CommandLine& line, std::ostream& out);

}  // namespace barchan
