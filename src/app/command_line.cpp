#include "src/app/command_line.hpp"

#include <sstream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "src/base/errors.hpp"
#include "src/base/words.hpp"

namespace barchan {
namespace {

/// Names an unknown command: CLI11 alone would say that a subcommand is missing.
void check_command(int argc, const char* const* argv) {
  const std::vector<std::string> commands{"run", "check", "new", "info", "keys"};
  if (argc < 2 || argv[1][0] == '-' || std::ranges::count(commands, argv[1]) > 0) return;
  throw InputError(fmt::format("unknown command \"{}\"{}; there are {}", argv[1],
                               did_you_mean(nearest(argv[1], commands)),
                               fmt::join(commands, ", ")));
}

/// Arguments that CLI11 lists as "not expected", in order, with the option each may have been meant
/// for.
std::string not_expected(const CLI::App& app, const CLI::App& command,
                         const std::vector<std::string>& overrides) {
  for (const std::string& key : overrides) {
    if (key.find('=') == key.npos)
      return fmt::format("--set {0} has no value: write --set {0}=VALUE, without blanks", key);
  }
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (std::string word : app.remaining(true)) {
    if (const auto equals = word.find('='); equals != word.npos) word.resize(equals);
    if (!word.starts_with("-")) continue;
    if (word == "--ranks") {
      return "--ranks is an option of the launcher, ./barchan run; with the program itself start "
             "ranks by mpirun -np N";
    }
    const std::string close = nearest(word, names);
    return fmt::format("unknown option {}{}; {} --help lists them", word,
                       close.empty() ? "" : fmt::format(" (did you mean {}?)", close),
                       command.get_name());
  }
  return {};
}

void add_new_case(CLI::App& command, NewCase& asked) {
  command.add_option("NAME", asked.name, "name of the case, and of its file NAME.toml")->required();
  CLI::Option* from =
      command
          .add_option("--from", asked.from, "a case to be based on, instead of the numbers below")
          ->type_name("CASE");
  const auto add = [&](const char* name, auto& value, const char* meaning, const char* type) {
    return command.add_option(name, value, meaning)->type_name(type)->excludes(from);
  };
  add("--grains", asked.grains, "number of grains (default: 3000)", "N")
      ->check(CLI::Range(100, 10'000'000));
  add("--diameter", asked.diameter, "mean diameter of the grains (default: 0.2mm)", "LENGTH");
  add("--density", asked.density, "density of the grains (default: 2500)", "KG/M3")
      ->check(CLI::Range(1001.0, 30000.0));
  add("--velocity", asked.velocity,
      "mean velocity of the water (default: one that moves these grains as in the paper)", "M/S")
      ->check(CLI::Range(1e-3, 100.0));
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version) {
  check_command(argc, argv);
  CommandLine line;
  CLI::App app{"Barchan: subaqueous dunes, every grain followed, the flow by large-eddy simulation",
               "barchan"};
  app.require_subcommand(1);
  app.set_version_flag("--version", version);
  const auto add_command = [&](Command command, const char* name, const char* what) {
    CLI::App* added = app.add_subcommand(name, what);
    added->callback([&line, command] { line.command = command; });
    return added;
  };
  CLI::App* run = add_command(Command::run, "run", "run a case");
  CLI::App* check =
      add_command(Command::check, "check", "validate a case; print what follows from its numbers");
  CLI::App* keys = add_command(Command::keys, "keys",
                               "the keys of a case with range, unit, default and meaning");
  CLI::Option* section = keys->add_option(
      "SECTION", line.section,
      "a section, as grains, or a key, as grains.skin (default: all, as docs/keys.md)");
  keys->add_flag("--schema", line.schema, "all as JSON Schema, for editors")->excludes(section);
  add_command(Command::info, "info", "what a run folder or a file holds")
      ->add_option("PATH", line.file,
                   "a run or study folder, a result, restart file, table or case")
      ->required();
  add_new_case(*add_command(Command::new_case, "new", "write a case of your own"), line.new_case);
  for (CLI::App* command : {run, check}) {
    command->add_option("CASE", line.file, "the case, a TOML file")->required();
    command->add_option("--set", line.overrides, "change one key, e.g. grains.sliding_friction=0.4")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);  // one value each: `--set a=1 case.toml` must not take case.toml
    command->add_option("--out", line.out, "run folder (default: runs/ and the path below configs)")
        ->type_name("DIR");
    command->add_option("--threads", line.threads, "threads per rank (default: all)")
        ->type_name("N")
        ->check(CLI::Range(1, kMostThreads));
  }
  CLI::Option* restart =
      run->add_option("--restart", line.restart,
                      "go on from this restart file, from the last one in this folder, or with "
                      "\"latest\" from the last one of the run")
          ->type_name("FILE");
  CLI::Option* resume =
      run->add_flag("--resume", line.resume,
                    "go on from the last restart file of the run; without one begin it")
          ->excludes(restart);
  run->add_option("--patience", line.patience,
                  "wall time without progress after which several ranks give up (default: 600, "
                  "0: never)")
      ->type_name("SECONDS")
      ->check(CLI::Range(0, 1'000'000));
  run->add_flag("--overwrite", line.overwrite,
                "remove the results of an earlier run in the folder and begin again")
      ->excludes(resume);
  run->add_flag(
      "--dry-run", line.dry_run,
      "check the case, print its derived numbers and warnings; nothing is run or written");
  run->add_flag("--starts-only", line.starts_only,
                "run the cases this one starts from where their results are missing, then stop");
  CLI::Option* quiet = run->add_flag_callback(
      "--quiet", [&line] { line.shown = report::Shown::problems; },
      "show warnings and errors only");
  run->add_flag_callback(
         "--verbose", [&line] { line.shown = report::Shown::details; },
         "show derived numbers, rates and iterations, which log.txt always has")
      ->excludes(quiet);
  check->add_flag("--resolved", line.resolved,
                  "print also the case with every default filled in, as TOML");
  check->add_flag("--resolved-only", line.resolved_only,
                  "print the case with every default as TOML, nothing else");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError& stop) {
    const std::string found = not_expected(app, *app.get_subcommands().front(), line.overrides);
    throw InputError(found.empty() ? stop.what() : found);
  } catch (const CLI::ParseError& stop) {
    std::ostringstream out, err;
    if (app.exit(stop, out, err) == 0) return {.text = out.str()};
    const std::string text = err.str();
    throw InputError(text.substr(0, text.find_last_not_of('\n') + 1));
  }
  return line;
}

}  // namespace barchan
