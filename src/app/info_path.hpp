// The command info: what lies at a path, whatever it is.
#pragma once

#include <filesystem>
#include <string>

namespace barchan {

/// A run or study folder, a result or restart file, a table or a case: several lines that say what
/// it holds and where it came from. Throws std::runtime_error with a sentence for the user.
std::string describe_path(const std::filesystem::path& path);

}  // namespace barchan
