// Bytes as a case: lines that begin with "--set " are overrides, all others the file.
#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "src/case/derived.hpp"
#include "src/case/load.hpp"
#include "src/case/resolved.hpp"
#include "src/case/validate.hpp"
#include "tests/fuzz/fuzzed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace barchan;

/// A folder with something to start from, so that cases that name another are loaded, too.
struct StartFolder : TemporaryFolder {
  StartFolder() {
    std::ofstream(*this / "flow.h5") << std::flush;
    std::ofstream(*this / "heap.csv") << std::flush;
    std::ofstream(*this / "start.toml")
        << "[time]\nend = 1\n[domain]\nsize = [0.1, 0.02, 0.02]\n"
           "[fluid]\ncells = [8, 4, 4]\nmean_velocity = 0.1\n"
           "[grains]\nsizes = [[2e-4, 10]]\n"
           "[initial]\ngrains = { pour = { centre = [0.05, 0.01], radius = 0.005 } }\n";
    std::ofstream(*this / "circle.toml") << "[time]\nend = 1\n[domain]\nsize = [1, 1, 1]\n"
                                            "[grains]\n[initial]\ngrains = \"circle.toml\"\n";
  }
};

struct Input {
  std::string text;
  std::vector<std::string> overrides;
};

Input split(std::string_view all) {
  constexpr std::string_view mark = "--set ";
  Input input;
  while (!all.empty()) {
    const auto end = std::min(all.find('\n'), all.size() - 1);
    const auto line = all.substr(0, end + 1);
    if (line.starts_with(mark)) {
      const auto assignment = line.substr(mark.size());
      input.overrides.emplace_back(assignment.substr(0, assignment.find('\n')));
    } else {
      input.text += line;
    }
    all.remove_prefix(line.size());
  }
  return input;
}

/// All that is made of a case before it runs, and that what config.toml says is the same case.
void use(const Config& config) {
  const auto sizes = config.grains ? config.grains->sizes : std::vector<SizeClass>{};
  for (const Finding& finding : validate(config, sizes)) {
    fuzz::demand(finding.severity == Finding::Severity::warning,
                 "what loads is valid:", finding.message);
  }
  config_warnings(config, sizes);
  to_text(derive(config, sizes));
  const std::string resolved = to_toml(config);
  std::string again;
  const bool loads =
      fuzz::accepts<ConfigError>([&] { again = to_toml(load_config_text(resolved, config.file)); });
  fuzz::demand(loads, "the resolved case loads:", resolved);
  fuzz::demand(again == resolved, "the resolved case is the same case:", resolved);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const StartFolder folder;
  const Input input = split(fuzz::as_text({data, size}));
  fuzz::accepts<ConfigError>(
      [&] { use(load_config_text(input.text, folder / "case.toml", input.overrides)); });
  // Text that a restart file carries: it may be anything.
  fuzz::accepts([&] {
    const Config written = config_as_written(input.text, folder / "restart.h5");
    restart_conflicts(Config{}, written);
    changed_keys(Config{}, written);
  });
  return 0;
}
