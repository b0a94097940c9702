// Checks of [[output.probe]] and [[output.slice]].
#pragma once

#include "src/case/config.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

void check_probe_keys(const Config& config, Findings& found);
void check_slice_keys(const Config& config, Findings& found);

}  // namespace barchan
