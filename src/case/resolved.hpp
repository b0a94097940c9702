// What the table of keys says of a configuration in words.
#pragma once

#include <string>
#include <vector>

#include "src/toml/keys.hpp"

namespace barchan {

/// The configuration with every default filled in: TOML that load_config_text turns into the same
/// Config (`file` aside). Paths of starts are absolute: the text means the same in any folder.
std::string to_toml(const Config& config, const Sections& table = sections());

/// What of `written`, the case a restart file comes from, a run of `config` cannot go on with: one
/// sentence for each key. Its numbers would be taken for something else without a further sign.
std::vector<std::string> restart_conflicts(const Config& config, const Config& written,
                                           const Sections& table = sections());

/// The other keys that differ, as in "grains.sliding_friction 0.6 -> 0.4".
std::vector<std::string> changed_keys(const Config& config, const Config& written,
                                      const Sections& table = sections());

}  // namespace barchan
