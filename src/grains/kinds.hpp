// Kinds of grains in a case.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/grains/grains_case.hpp"

namespace barchan {

/// Kinds of a case. A case without [[grains.kind]] has one, that of [grains], without a name.
std::vector<KindConfig> all_kinds(const GrainConfig& grains);

/// Sizes of the grains to pour: those of all kinds, each with its kind.
std::vector<SizeClass> poured_sizes(const GrainConfig& grains);

/// Section of a kind of all_kinds, for messages: "grains" or "grains.kind.2", counted from 1.
std::string section_of_kind(const GrainConfig& grains, std::size_t kind);

/// Index of a kind in all_kinds, by its name; -1: there is none.
int kind_of_name(const GrainConfig& grains, std::string_view name);

/// Fault of grains that come with kinds of these names, in words that follow "must"; empty if the
/// case has them all.
std::string unknown_kinds(const GrainConfig& grains, const std::vector<std::string>& names);
std::vector<std::string> names_of_kinds(const GrainConfig& grains);

/// Sizes of another case with its kinds as entries of this one, by name; 0 where there is none.
std::vector<SizeClass> with_kinds_of(const GrainConfig& grains, const GrainConfig& other,
                                     std::vector<SizeClass> sizes);

}  // namespace barchan
