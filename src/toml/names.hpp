// Names that a case gives to heaps and bodies.
#pragma once

#include <string>

#include "src/toml/findings.hpp"

namespace barchan {

/// Checks a name: one cell of a table, also of one that a spreadsheet opens, where it must be no
/// formula.
void check_name(const std::string& name, const KeyNames& keys, Findings& found);

}  // namespace barchan
