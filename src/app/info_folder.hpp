// The command info: folders.
#pragma once

#include <filesystem>
#include <string>

namespace barchan {

/// What run.json or study.json says of a folder, with the files in it. Throws std::runtime_error
/// with a sentence for the user if it is neither a run nor a study.
std::string describe_folder(const std::filesystem::path& folder);

}  // namespace barchan
