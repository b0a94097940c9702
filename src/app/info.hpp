// Command info: result and restart files.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace barchan {

/// Describes a result or restart file in several lines: its content, and where it came from. Throws
/// std::runtime_error with a sentence for the user when it is missing, cut short, or not one of
/// ours. A file that changed a moment ago may be in the hands of a run: it is tried again for as
/// long as `patience`.
std::string describe_file(const std::filesystem::path& path,
                          std::chrono::milliseconds patience = std::chrono::seconds{1});

}  // namespace barchan
