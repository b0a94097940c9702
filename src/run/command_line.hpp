// What the user typed, as a struct.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace barchan {

/// `none`: nothing to do but print `text` and leave with `exit_code` (help, version, bad usage).
enum class Command { none, run, check, keys, info };

struct CommandLine {
  Command command = Command::none;
  int exit_code = 0;  // with Command::none: 0 after help or version, 2 after bad usage
  std::string text;   // with Command::none: for stdout when exit_code is 0, else for stderr

  std::filesystem::path file;                    // CONFIG of run and check, FILE.h5 of info
  std::vector<std::string> overrides;            // --set, each "key=value" as typed
  std::optional<std::filesystem::path> out;      // --out, the run folder
  std::optional<std::filesystem::path> restart;  // --restart, a restart file to go on from
  int threads = 0;                               // --threads, 0: all that are there
  int patience = 600;                            // --patience of the watchdog [s], 0: for ever
  bool dry_run = false;                          // --dry-run: check and show, write nothing
  bool starts_only = false;                      // --starts-only: run what the case starts from
  bool quiet = false;                            // --quiet: no live line
  bool resolved_only = false;  // --resolved-only: of check the TOML alone, for other programs
};

/// Reads the command line; prints nothing and never exits, so that one rank can speak for all.
/// `version` is the text for --version.
CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version);

}  // namespace barchan
