// Keys of [[body]].
#pragma once

#include "src/toml/keys.hpp"

namespace barchan {

void add_bodies(Sections& all);

}  // namespace barchan
