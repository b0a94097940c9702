// A configuration written out in full, every default filled in.
#pragma once

#include <string>

#include "src/config/config.hpp"

namespace barchan {

/// TOML that load_config_text turns into the same Config (`file` aside). Paths of starts are
/// absolute, so that the text means the same in any folder.
std::string to_toml(const Config& config);

}  // namespace barchan
