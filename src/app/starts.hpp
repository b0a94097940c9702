// The cases that a case starts from, and the grains that it will start with, before anything is
// run.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "src/config/config.hpp"
#include "src/grains/initial_grains.hpp"
#include "src/run/folder_checks.hpp"

namespace barchan {

/// A case that another one starts from, [initial] fluid or grains = a .toml.
struct StartCase {
  Config first;   // as it stands in its file
  Config config;  // in the realisation that is asked for
  std::filesystem::path folder;
  EarlierRun earlier;  // what is in the folder
};

/// The start `source`, a .toml, in a realisation. Its folder is in `beside`, that of the run.
/// Throws ConfigError.
StartCase start_case(const std::filesystem::path& source, const std::filesystem::path& beside,
                     int realisation);

/// The starts whose results are missing, in the order in which a run in `folder` would make them.
std::vector<StartCase> missing_starts(const Config& config, const std::filesystem::path& folder);

/// The grains that a run will start with, as far as they are known before it.
struct GrainsAhead {
  std::vector<SizeClass> sizes;         // empty: there are no grains
  std::optional<InitialGrains> grains;  // none: they are still to be poured, here or in a start
  Config poured_in;                     // that case, if none
  std::filesystem::path source;         // the file that they are in, or the case that pours them
};

/// Reads the table or the results that initial.grains names, and checks that the grains fit the
/// case as a run does. Of a start that has no results yet: what that one starts with. Throws
/// InputError.
GrainsAhead grains_ahead(const Config& config, const std::filesystem::path& folder);

}  // namespace barchan
