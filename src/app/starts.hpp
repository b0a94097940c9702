// Cases that a case starts from, and the grains that it will start with, before anything is run.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/app/command_line.hpp"
#include "src/case/load.hpp"
#include "src/grains/initial_grains.hpp"
#include "src/run/folder_checks.hpp"

namespace barchan {

/// Folder as messages show it: as short as it can be typed here.
std::string shown(const std::filesystem::path& folder);

/// Case of a command line. Throws ConfigError.
Case load_case_of(const CommandLine& line);

/// Case that another one starts from: [initial] fluid or grains = a .toml.
struct StartCase {
  Case realised;  // case in the realisation that is asked for
  std::filesystem::path folder;
  EarlierRun earlier;  // run in the folder
};

/// Start in a realisation. Its folder is in `runs`, the folder_of_runs() of what starts from it.
StartCase start_case(const Case& source, const std::filesystem::path& runs, int realisation);

/// Result of recorded_inputs() for a run that begins now in `folder`. A start adds what that one
/// began from, if it says so.
nlohmann::json inputs_to_record(const Case& the_case, const std::filesystem::path& folder);

/// Starts whose results are missing, in the order in which a run in `folder` would make them.
std::vector<StartCase> missing_starts(const Case& the_case, const std::filesystem::path& folder);

/// Throws InputError if what a run in `folder` would compute is there, finished, in the folder that
/// earlier versions took: runs/ and the last part of its name.
void check_earlier_places(const Case& the_case, const std::filesystem::path& folder);

/// Grains that a run will start with, as far as they are known before it.
struct PlannedGrains {
  SettledCase settled;                  // the case with their sizes, of which it may have none
  std::optional<InitialGrains> grains;  // empty: they are still to be poured, here or in a start
  SettledCase poured_in;                // the case that pours them, if `grains` is empty
  std::filesystem::path source;         // the file that they are in, or the case that pours them
};

/// Reads the table or the results that initial.grains names, and checks that the grains fit the
/// case as a run does. A start that has no results yet gives what that one starts with. Throws
/// InputError, also if bodies block the flow.
PlannedGrains planned_grains(const Case& the_case, const std::filesystem::path& folder);

}  // namespace barchan
