// A case from its configuration to its results, and the cases it starts from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "src/command_line.hpp"
#include "src/config.hpp"
#include "src/fluid_state.hpp"
#include "src/provenance.hpp"

namespace barchan {

/// The `run` command. Returns the exit code: 0 done, 3 stopped on request. Throws ConfigError (exit
/// code 2) and std::runtime_error (exit code 1).
int run_command(const CommandLine& line);

/// Folder of a case's results: runs/<name of the config file>.
std::filesystem::path default_run_folder(const std::filesystem::path& config_file);

Provenance make_provenance(const Config& config);
/// Backend and what it runs on, in words.
std::string device_name();
/// A flow at rest on the grid of the case.
FluidState empty_fluid(const Config& config);

}  // namespace barchan
