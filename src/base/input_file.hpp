// Whether a name that the user gave can be read as a file.
#pragma once

#include <filesystem>
#include <string>

namespace barchan {

/// Why `path` is not a file to read, "No such file or directory" or the like; empty if it is one.
/// Devices and pipes count as none: reading them may never end.
std::string not_a_file(const std::filesystem::path& path);

}  // namespace barchan
