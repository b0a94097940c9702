// Keys of [coupling] and of its schemes.
#pragma once

#include "src/toml/keys.hpp"

namespace barchan {

void add_coupling(Sections& all);
void add_schemes(Sections& all);

}  // namespace barchan
