// A case from its configuration to its results, and the cases it starts from.
#pragma once

#include <filesystem>

#include "src/run/command_line.hpp"

namespace barchan {

/// The `run` command. Returns the exit code: 0 done, 3 stopped on request. Throws ConfigError (exit
/// code 2) and std::runtime_error (exit code 1).
int run_command(const CommandLine& line);

/// Folder of a case's results: runs/<name of the config file>.
std::filesystem::path default_run_folder(const std::filesystem::path& config_file);

}  // namespace barchan
