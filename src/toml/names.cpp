#include "src/toml/names.hpp"

namespace barchan {

void check_name(const std::string& name, const KeyNames& keys, Findings& found) {
  const bool one_cell = !name.empty() && name.find_first_of("\n,;\"") == std::string::npos;
  const bool is_formula = name.find_first_of("=+-@ ") == 0;
  found.error_if(!one_cell || is_formula, keys,
                 "must be one line without \",\", \";\" and quotes, and must not begin with \"=\", "
                 "\"+\", \"-\", \"@\" or a space");
}

}  // namespace barchan
