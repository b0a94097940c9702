// The text of a case file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/toml/toml_tree.hpp"

namespace barchan {

/// Nothing, and a problem, if the file cannot be read or is far too long for a case.
std::optional<std::string> case_text(const std::filesystem::path& file,
                                     std::vector<Problem>& problems);

}  // namespace barchan
