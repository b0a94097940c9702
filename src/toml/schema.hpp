// Table of keys as JSON Schema, for editors and other programs.
#pragma once

#include <string>

#include "src/toml/keys.hpp"

namespace barchan {

/// JSON Schema, draft 4, of a case: the keys of each section with type, range, choices, default and
/// meaning. It cannot say how keys must fit together: `check` does.
std::string case_schema(const Sections& table = sections());

}  // namespace barchan
