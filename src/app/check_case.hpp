// The command check.
#pragma once

#include <iosfwd>

#include "src/app/command_line.hpp"

namespace barchan {

/// Mark that --resolved-only prints, behind a #, about a run folder given with --out whose results
/// are from other content of an input file.
inline constexpr const char* kChangedInput = "changed since: ";

/// Writes the resolved configuration, its derived numbers, its cost and its warnings to `out`, the
/// first alone with --resolved-only (and then Kokkos need not run); returns the exit code 0. Throws
/// ConfigError when the case is not valid, InputError when its grains do not suit it.
int run_check(const CommandLine& line, std::ostream& out);

}  // namespace barchan
