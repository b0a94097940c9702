// What a misspelt word was meant for.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace barchan {

/// The candidate nearest to `typed` by edits (a swap of neighbours counts once); empty if none is
/// near enough to be meant.
std::string nearest(std::string_view typed, std::span<const std::string> candidates);

}  // namespace barchan
