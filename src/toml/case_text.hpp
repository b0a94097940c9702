// Text of a case file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/toml/toml_tree.hpp"

namespace barchan {

/// Text of a file; empty, with a problem added, if it cannot be read or is far too long for a case.
std::optional<std::string> case_text(const std::filesystem::path& file,
                                     std::vector<Problem>& problems);

}  // namespace barchan
