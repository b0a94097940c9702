// Memory that a case needs, and that this machine has.
#pragma once

#include <string>
#include <vector>

#include "src/case/config.hpp"

namespace barchan {

/// Number of grains that a feed of a given rate brings in until the end of the run; how many of
/// them leave is not known beforehand.
double fed_grains(const Config& config);

/// Estimated memory of all ranks together [bytes]. `sizes`: of its grains.
double memory_of_case(const Config& config, const std::vector<SizeClass>& sizes);

/// Line about the memory, beside those of to_text(Derived).
std::string memory_line(const Config& config, const std::vector<SizeClass>& sizes);

/// [bytes]
double memory_of_machine();

/// Refuses a case that this machine cannot hold, before any memory is taken. Throws InputError.
void check_memory(const Config& config, const std::vector<SizeClass>& sizes);

}  // namespace barchan
