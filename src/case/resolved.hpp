// Configurations as text, and their differences key by key.
#pragma once

#include <string>
#include <vector>

#include "src/toml/keys.hpp"

namespace barchan {

/// Configuration with every default filled in: TOML that load_config_text turns into the same
/// Config (`file` aside). Paths of starts are absolute: the text means the same in any folder.
std::string to_toml(const Config& config, const Sections& table = sections());

/// Keys of `written`, the case a restart file comes from, with which a run of `config` cannot go
/// on: one sentence each. Its numbers would be taken for something else without a further sign.
std::vector<std::string> restart_conflicts(const Config& config, const Config& written,
                                           const Sections& table = sections());

/// Other keys that differ, as in "grains.sliding_friction 0.6 -> 0.4".
std::vector<std::string> changed_keys(const Config& config, const Config& written,
                                      const Sections& table = sections());

}  // namespace barchan
