// Keys of [case] and [time].
#pragma once

#include "src/toml/keys.hpp"

namespace barchan {

void add_case(Sections& all);
void add_time(Sections& all);

}  // namespace barchan
