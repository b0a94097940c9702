// What the user typed, and the commands run, check and info.
#pragma once

#include <chrono>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace barchan {

/// `none`: nothing to do but print `text` (help, version).
enum class Command { none, run, check, keys, info };

struct CommandLine {
  Command command = Command::none;
  std::string text{};  // with Command::none

  std::filesystem::path file{};                    // CONFIG of run and check, FILE.h5 of info
  std::vector<std::string> overrides{};            // --set, each "key=value" as typed
  std::optional<std::filesystem::path> out{};      // --out, the run folder
  std::optional<std::filesystem::path> restart{};  // --restart, a restart file to go on from
  int threads = 0;                                 // --threads, 0: all that are there
  int patience = 600;                              // --patience of the watchdog [s], 0: for ever
  bool overwrite = false;                          // --overwrite: an earlier run in the folder
  bool dry_run = false;                            // --dry-run: check and show, write nothing
  bool starts_only = false;                        // --starts-only: run what the case starts from
  bool quiet = false;                              // --quiet: no live line
  bool resolved_only = false;  // --resolved-only: of check the TOML alone, for other programs
};

/// Reads the command line; prints nothing and never exits, so that one rank can speak for all.
/// `version` is the text for --version. Throws InputError after bad usage.
CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version);

/// --out, or runs/<name of the case>.
std::filesystem::path run_folder(const CommandLine& line);

/// [bytes]
double memory_of_machine();

/// A case from its configuration to its results, and the cases it starts from. Returns the exit
/// code: 0 done, 3 stopped on request. Throws ConfigError (exit code 2) and std::runtime_error
/// (exit code 1).
int run_command(const CommandLine& line);

/// Writes the resolved configuration, its derived numbers, what it will cost and its warnings to
/// `out`, the first alone with --resolved-only (and then Kokkos need not run); returns the exit
/// code 0. Throws ConfigError when the case is not valid, InputError when its grains do not suit
/// it.
int run_check(const CommandLine& line, std::ostream& out);

/// What a result or restart file holds, and where it came from: several lines. Throws
/// std::runtime_error with a sentence for the user when it is missing, cut short, or not one of
/// ours. A file that changed a moment ago may be in the hands of a run: it is tried again for as
/// long as `patience`.
std::string describe_file(const std::filesystem::path& path,
                          std::chrono::milliseconds patience = std::chrono::seconds{1});

}  // namespace barchan
