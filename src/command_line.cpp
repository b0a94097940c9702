#include "src/command_line.hpp"

#include <sstream>

#include <CLI/CLI.hpp>

namespace barchan {
namespace {

void add_overrides(CLI::App& command, CommandLine& line) {
  command.add_option("--set", line.overrides, "change one key, e.g. grains.sliding_friction=0.4")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);  // one value each: `--set a=1 case.toml` must not take case.toml
}

CLI::App* add_run(CLI::App& app, CommandLine& line) {
  CLI::App* run = app.add_subcommand("run", "run a case");
  run->add_option("CONFIG", line.file, "the case, a TOML file")->required();
  add_overrides(*run, line);
  run->add_option("--out", line.out, "run folder (default: runs/<config name>)")->type_name("DIR");
  run->add_option("--restart", line.restart, "go on from this restart file")->type_name("FILE");
  run->add_option("--threads", line.threads, "threads per rank (default: all)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  run->add_flag("--dry-run", line.dry_run, "set everything up, then stop before the first step");
  run->add_flag("--quiet", line.quiet, "no live line on the terminal");
  return run;
}

CLI::App* add_check(CLI::App& app, CommandLine& line) {
  CLI::App* check =
      app.add_subcommand("check", "validate a case; print it resolved, with derived numbers");
  check->add_option("CONFIG", line.file, "the case, a TOML file")->required();
  add_overrides(*check, line);
  return check;
}

CLI::App* add_info(CLI::App& app, CommandLine& line) {
  CLI::App* info = app.add_subcommand("info", "what a result or restart file holds");
  info->add_option("FILE", line.file, "an HDF5 file")->required();
  return info;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version) {
  CommandLine line;
  CLI::App app{"Barchan: subaqueous dunes, every grain followed, the flow by large-eddy simulation",
               "barchan"};
  app.require_subcommand(1);
  app.set_version_flag("--version", version);
  const CLI::App* run = add_run(app, line);
  const CLI::App* check = add_check(app, line);
  add_info(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    std::ostringstream out, err;
    CommandLine nothing;
    nothing.exit_code = app.exit(stop, out, err) == 0 ? 0 : 2;
    nothing.text = nothing.exit_code == 0 ? out.str() : err.str();
    return nothing;
  }
  line.command = run->parsed() ? Command::run : check->parsed() ? Command::check : Command::info;
  return line;
}

}  // namespace barchan
