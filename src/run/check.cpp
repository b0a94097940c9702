#include "src/run/check.hpp"

#include "src/config/derived.hpp"
#include "src/config/load.hpp"
#include "src/config/resolved.hpp"
#include "src/config/validate.hpp"

namespace barchan {

int run_check(const CommandLine& line, std::ostream& out) {
  const Config config = load_config(line.file, line.overrides);
  if (line.resolved_only) {
    out << to_toml(config);
    return 0;
  }
  const std::vector<SizeClass> sizes = known_sizes(config);
  out << "# " << line.file.string() << ", every default filled in\n\n" << to_toml(config);
  out << "\n# What follows from it\n\n" << to_text(derive(config, sizes));
  if (config.grains && sizes.empty()) {
    out << "  grain sizes             as in " << config.initial.grains.string()
        << ": the grain step is checked against them in the run\n";
  }
  const auto warnings = config_warnings(config, sizes);
  if (!warnings.empty()) out << '\n';
  for (const std::string& warning : warnings) out << warning << '\n';
  return 0;
}

}  // namespace barchan
