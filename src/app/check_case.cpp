#include "src/app/check_case.hpp"

#include <ostream>

#include "src/app/estimate.hpp"
#include "src/app/memory.hpp"
#include "src/base/errors.hpp"
#include "src/case/load.hpp"
#include "src/case/resolved.hpp"

namespace barchan {

int run_check(const CommandLine& line, std::ostream& out) {
  const Case the_case = load_case_of(line);
  const Config& config = the_case.config;
  if (line.resolved_only) {
    out << to_toml(config);
    if (!line.out) return 0;
    if (const auto changed = earlier_run(the_case, *line.out).changed)
      out << "# " << kChangedInput << changed->string() << '\n';
    return 0;
  }
  const std::filesystem::path folder = run_folder(line);
  const PlannedGrains planned = planned_grains(the_case, folder);
  for (const StartCase& start : missing_starts(the_case, folder))
    planned_grains(start.realised, start.folder);  // throws if the run of a start would
  std::string cost = "  wall time               not timed: this machine has too little memory\n";
  if (memory_of_case(config, planned.settled.sizes) < memory_of_machine())
    cost = as_input([&] { return estimate(the_case, folder, planned); });
  out << to_text(planned.settled.numbers) << memory_line(config, planned.settled.sizes) << cost;
  const auto warnings = case_warnings(the_case, planned.settled.sizes);
  if (!warnings.empty()) out << '\n';
  for (const std::string& warning : warnings) out << "warning: " << warning << '\n';
  if (line.resolved) out << "\n# The case, every default filled in\n\n" << to_toml(config);
  return 0;
}

}  // namespace barchan
