#include "src/app/check_case.hpp"

#include <algorithm>
#include <ostream>

#include "src/app/estimate.hpp"
#include "src/app/memory.hpp"
#include "src/base/errors.hpp"
#include "src/config/derived.hpp"
#include "src/config/load.hpp"
#include "src/config/resolved.hpp"
#include "src/config/validate.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

/// Highest point of the grains that a run starts with [m], before they settle where they are still
/// to be poured; 0 without grains.
double top_of(const GrainsAhead& ahead) {
  if (!ahead.grains) {
    if (ahead.sizes.empty()) return 0;
    const PourConfig& pour = *ahead.poured_in.initial.pour;
    double count = 0;
    for (const SizeClass& size : ahead.sizes) count += static_cast<double>(size.count);
    return pour.drop_height +
           poured_height(pour, ahead.poured_in.size, count, poured_spacing(ahead.sizes));
  }
  double top = 0;
  for (std::size_t g = 0; g < ahead.grains->size(); ++g)
    top = std::max(top, ahead.grains->x[g].y + ahead.grains->diameter[g] / 2);
  return top;
}

}  // namespace

int run_check(const CommandLine& line, std::ostream& out) {
  const Case the_case = load_case(line.file, line.overrides);
  const Config& config = the_case.config;
  if (line.resolved_only) {
    out << to_toml(config);
    return 0;
  }
  const std::filesystem::path folder = run_folder(line);
  const GrainsAhead ahead = grains_ahead(the_case, folder);
  for (const StartCase& start : missing_starts(the_case, folder))
    grains_ahead(start.realised, start.folder);  // throws if the run of a start would
  Derived derived = derive(config, ahead.sizes, top_of(ahead));
  if (derived.grains) derived.grains->as_poured = !ahead.grains;
  std::string cost = "  wall time               not timed: this machine has too little memory\n";
  if (memory_of_case(config, ahead.sizes) < memory_of_machine())
    cost = as_input([&] { return estimate(the_case, folder, ahead); });
  out << "# " << line.file.string() << ", every default filled in\n\n" << to_toml(config);
  out << "\n# What follows from it\n\n"
      << to_text(derived) << memory_line(config, ahead.sizes) << cost;
  const auto warnings = config_warnings(config, ahead.sizes);
  if (!warnings.empty()) out << '\n';
  for (const std::string& warning : warnings) out << warning << '\n';
  return 0;
}

}  // namespace barchan
