// Command info: whatever lies at a path.
#pragma once

#include <filesystem>
#include <string>

namespace barchan {

/// Describes a run or study folder, a result or restart file, a table or a case in several lines:
/// its content, and where it came from. Throws std::runtime_error with a sentence for the user.
std::string describe_path(const std::filesystem::path& path);

}  // namespace barchan
