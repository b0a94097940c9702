// Command line: what the user typed, read into a struct.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/app/new_case.hpp"
#include "src/base/report.hpp"

namespace barchan {

/// Largest number of threads of a rank: Kokkos' OpenMP backend writes beyond its tables with more.
inline constexpr int kMostThreads = 512;

/// Command to run. `none`: nothing to do but print `text` (help, version).
enum class Command { none, run, check, keys, info, new_case };

struct CommandLine {
  Command command = Command::none;
  std::string text{};  // answer of Command::none

  std::filesystem::path file{};                // CONFIG of run and check, PATH of info
  std::string section{};                       // --section of keys; empty: all sections
  std::vector<std::string> overrides{};        // --set, each "key=value" as typed
  std::optional<std::filesystem::path> out{};  // --out, the run folder
  std::optional<std::filesystem::path>
      restart{};                                  // --restart: a restart file, a folder or "latest"
  bool resume = false;                            // --resume: from the last restart file, if any
  int threads = 0;                                // --threads, 0: all that are there
  int patience = 600;                             // --patience of the watchdog [s], 0: for ever
  bool overwrite = false;                         // --overwrite: an earlier run in the folder
  bool dry_run = false;                           // --dry-run: check and show, write nothing
  bool starts_only = false;                       // --starts-only: run what the case starts from
  report::Shown shown = report::Shown::progress;  // --quiet, --verbose
  bool resolved = false;                          // --resolved: check prints the TOML, too
  NewCase new_case{};                             // arguments of new
  bool resolved_only = false;  // --resolved-only: check prints the TOML alone, for other programs
  bool schema = false;         // --schema: keys prints a JSON Schema
};

/// Reads the command line; prints nothing and never exits, so that one rank can speak for all.
/// `version` is the text for --version. Throws InputError after bad usage.
CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version);

/// Run folder: --out, or runs/ and the case_name().
std::filesystem::path run_folder(const CommandLine& line);

}  // namespace barchan
