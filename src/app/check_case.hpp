// The command check.
#pragma once

#include <iosfwd>

#include "src/app/command_line.hpp"

namespace barchan {

/// What --resolved-only says, behind a #, of a run folder given with --out whose results are from
/// another content of a file.
inline constexpr const char* kChangedInput = "changed since: ";

/// Writes the resolved configuration, its derived numbers, what it will cost and its warnings to
/// `out`, the first alone with --resolved-only (and then Kokkos need not run); returns the exit
/// code 0. Throws ConfigError when the case is not valid, InputError when its grains do not suit
/// it.
int run_check(const CommandLine& line, std::ostream& out);

}  // namespace barchan
