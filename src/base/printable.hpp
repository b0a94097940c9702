// Text from outside in messages: what a terminal would obey or could not show is spelt out.
#pragma once

#include <string>
#include <string_view>

namespace barchan {

/// Control characters and bytes that are not UTF-8 as \n, \x1b, \xff; `longest` bytes at most, then
/// "...".
std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// The same for a message of several lines: these stay.
std::string printable_lines(std::string_view text);

}  // namespace barchan
