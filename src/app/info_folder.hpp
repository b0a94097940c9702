// Command info: folders.
#pragma once

#include <filesystem>
#include <string>

namespace barchan {

/// Describes a folder from its run.json or study.json, with the files in it. Throws
/// std::runtime_error with a sentence for the user if it is neither a run nor a study.
std::string describe_folder(const std::filesystem::path& folder);

}  // namespace barchan
