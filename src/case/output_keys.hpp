// Keys of [output] and [[output.probe]].
#pragma once

#include "src/toml/keys.hpp"

namespace barchan {

void add_output(Sections& all);
void add_probes(Sections& all);
void add_slices(Sections& all);

}  // namespace barchan
