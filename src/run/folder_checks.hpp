// Checks of a folder for results, made before anything is computed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "src/case/load.hpp"

namespace barchan {

/// Throws InputError if `folder` cannot be made or written, or holds folders in the place of
/// results. Makes nothing.
void check_out_folder(const std::filesystem::path& folder);
/// Throws InputError if `folder` holds files with names of results, but no run.json of a run: they
/// are somebody's own. The case itself does not count, nor do restart files.
void check_is_ours(const Config& config, const std::filesystem::path& folder);
/// Throws InputError if a new run in `folder` would remove what it starts from, the case itself
/// included.
void check_nothing_is_lost(const Config& config, const std::filesystem::path& folder);
/// Throws InputError if a restart cannot go on with the tables and frames in `folder`.
void check_results_go_on(const std::filesystem::path& folder);

/// Earlier run, whose results are in a folder.
struct EarlierRun {
  std::string status;                            // as in run.json; empty: no run
  bool same_config = false;                      // its configuration is exactly this one
  std::optional<std::filesystem::path> changed;  // file that it began from, with other content now
  std::optional<std::filesystem::path> restart;  // its last restart file
  bool same() const { return same_config && !changed; }
  bool done() const { return status == "done" && same() && restart; }
  bool is_worth_keeping() const { return status == "done" || restart; }
  /// Difference between it and the case, as in "of another configuration"; empty: none.
  std::string difference() const;
};
EarlierRun earlier_run(const Case& the_case, const std::filesystem::path& folder);
/// Throws InputError if a new run in `folder` would remove an earlier one that is worth keeping.
void check_overwrites_nothing(const EarlierRun& earlier, const std::filesystem::path& folder);

}  // namespace barchan
