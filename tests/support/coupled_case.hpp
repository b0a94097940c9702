// A small coupled case: 200 grains in a turbulent channel of 12 x 6 x 6 mm.
#pragma once

#include "src/case/load.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan::test {

inline Config coupled_config() {
  return load_config(std::filesystem::path(BARCHAN_SOURCE_DIR) / "tests/support/small_dune.toml");
}

}  // namespace barchan::test
