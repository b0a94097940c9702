// Whether results can go where the user wants them, asked before anything is computed.
#pragma once

#include <filesystem>

#include "src/config/config.hpp"

namespace barchan {

/// Throws InputError if `folder` cannot be made or written, or holds folders where results go.
/// Makes nothing.
void check_out_folder(const std::filesystem::path& folder);

/// Throws InputError if a new run in `folder` would remove what it starts from, the case itself
/// included.
void check_nothing_is_lost(const Config& config, const std::filesystem::path& folder);

/// Throws InputError if the tables and frames in `folder` are not such as a restart goes on with.
void check_results_go_on(const std::filesystem::path& folder);

}  // namespace barchan
