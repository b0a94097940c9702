// `barchan info`: what a result or restart file holds, and where it came from.
#pragma once

#include <filesystem>
#include <string>

namespace barchan {

/// Description of the file, several lines. Throws std::runtime_error with a sentence for the user
/// when it is missing, cut short, or not one of ours.
std::string describe_file(const std::filesystem::path& path);

/// Prints the description to standard output, or the problem to standard error. Exit code 0 or 2.
int run_info(const std::filesystem::path& file);

}  // namespace barchan
