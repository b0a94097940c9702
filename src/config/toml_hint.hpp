// What a reader is told beyond the parser's words when a file is not TOML.
#pragma once

#include <string>
#include <string_view>

namespace barchan {

/// Why `text` cannot be given to the parser at all: it is no text, or names nested so deep that
/// they could only exhaust the stack. The line of it, or 0 when there is nothing to say.
struct Unparsable {
  int line = 0;
  std::string why;
};
Unparsable unparsable(std::string_view text);

/// True if a dotted key has more parts than any key of ours could.
bool is_too_deep(std::string_view dotted_key);

/// The likely slip in line `line` of `text`, " (as a remedy)"; empty if none is known.
std::string toml_hint(std::string_view text, int line);

}  // namespace barchan
