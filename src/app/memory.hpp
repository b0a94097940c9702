// What a case needs of memory, and what this machine has.
#pragma once

#include <string>
#include <vector>

#include "src/case/config.hpp"

namespace barchan {

/// Grains that a feed of a given rate brings in until the end of the run; how many of them leave is
/// not known beforehand.
double fed_grains(const Config& config);

/// About, of all ranks together [bytes]. `sizes`: of its grains.
double memory_of_case(const Config& config, const std::vector<SizeClass>& sizes);

/// The line about it beside those of to_text(Derived).
std::string memory_line(const Config& config, const std::vector<SizeClass>& sizes);

/// [bytes]
double memory_of_machine();

/// Refuses what this machine cannot hold, before it is asked for the memory. Throws InputError.
void check_memory(const Config& config, const std::vector<SizeClass>& sizes);

}  // namespace barchan
