// The table of keys for editors and other programs that read JSON Schema.
#pragma once

#include <string>

#include "src/toml/keys.hpp"

namespace barchan {

/// JSON Schema, draft 4, of a case: the keys of each section with type, range, choices, default and
/// meaning. What several keys must be together it cannot say: `check` does.
std::string case_schema(const Sections& table = sections());

}  // namespace barchan
