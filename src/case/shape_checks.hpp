// Checks of the shapes of grains.
#pragma once

#include "src/case/config.hpp"
#include "src/case/derived.hpp"
#include "src/toml/findings.hpp"

namespace barchan {

/// Checks that shapes are whole, and that what a case asks for is there for clumps.
void check_shapes(const Config& c, Findings& found);

/// Checks that clumps do not meet their own images. `sizes`: of the grains.
void check_clump_sizes(const Config& c, const std::vector<SizeClass>& sizes, Findings& found);

/// Checks that the smallest sphere of a clump goes less than half its radius in a grain step,
/// beyond which a run stops (state_checks.hpp). Its speed is that of impacts, or that after a fall
/// over a diameter, v^2 = 2 g d.
void check_smallest_sphere(const Config& c, const KindNumbers& kind, const std::string& who,
                           Findings& found);

}  // namespace barchan
