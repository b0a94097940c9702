// Checks of grains that move in a flow resolved around them. The case has [fluid] and [grains].
#pragma once

#include <vector>

#include "src/case/derived.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks what such a case must not have.
void check_immersed(const Config& config, Findings& found);
/// Checks cells against grains, whose sizes are known.
void check_immersed_cells(const Config& config, const GrainNumbers& numbers, Findings& found);

/// Longest grain step [s] with the thinnest film between grains of these sizes, whose damping is
/// explicit; infinity without films.
double film_step_limit(const Config& config, const std::vector<SizeClass>& sizes);
/// Gap [m] across which grains feel the film between them; 0 without films.
double film_reach(const Config& config);

}  // namespace barchan
