// What the user typed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/app/new_case.hpp"
#include "src/base/report.hpp"

namespace barchan {

/// Threads of a rank in Kokkos' OpenMP backend, which writes beyond its tables with more.
inline constexpr int kMostThreads = 512;

/// `none`: nothing to do but print `text` (help, version).
enum class Command { none, run, check, keys, info, new_case };

struct CommandLine {
  Command command = Command::none;
  std::string text{};  // with Command::none

  std::filesystem::path file{};                // CONFIG of run and check, PATH of info
  std::string section{};                       // of keys; empty: all
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
  bool resolved = false;                          // --resolved: of check also the TOML
  NewCase new_case{};                             // of new
  bool resolved_only = false;  // --resolved-only: of check the TOML alone, for other programs
  bool schema = false;         // --schema: of keys as JSON Schema
};

/// Reads the command line; prints nothing and never exits, so that one rank can speak for all.
/// `version` is the text for --version. Throws InputError after bad usage.
CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version);

/// --out, or runs/ and the case_name().
std::filesystem::path run_folder(const CommandLine& line);

}  // namespace barchan
