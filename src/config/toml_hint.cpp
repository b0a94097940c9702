#include "src/config/toml_hint.hpp"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

namespace barchan {

namespace {

constexpr int most_parts = 16;  // ours have four

std::string_view line_of(std::string_view text, int line) {
  for (; line > 1; --line) {
    const auto end = text.find('\n');
    if (end == text.npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// Points in a row that join parts of a key: outside quotes and comments, nothing but names
/// between.
bool has_deep_key(std::string_view line) {
  int points = 0;
  char quote = 0;
  for (const char c : line) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      return false;
    } else if (c == '.') {
      if (++points >= most_parts) return true;
    } else if (c == '=' || c == ',' || c == '[' || c == '{') {
      points = 0;
    }
  }
  return false;
}

/// What a value that is no TOML begins with, and what was probably meant.
struct Slip {
  const char *value, *remedy;
};
constexpr Slip slips[] = {
    {R"(".*\\)", "a backslash in \"...\" begins an escape: write '...' or / instead"},
    {R"([A-Za-z])", "text stands in quotes; true and false are lower case"},
    {R"([-+]*\d[-+.\d]*,\d)", "decimals come after a point, not a comma"},
    {R"([-+]*(\.\d|\d+\.(\D|$)))", "a digit must stand on both sides of the point, as in 0.01"},
    {R"([-+.\d]*\d[-+.\d]*[dD])", "exponents are written with e, as in 5e-6"},
    {R"([-+.\d]*\d[-+.\d]*\s*[A-DF-Za-df-wyz])", "numbers stand without a unit; all are SI"}};

}  // namespace

bool is_too_deep(std::string_view dotted_key) {
  return std::count(dotted_key.begin(), dotted_key.end(), '.') >= most_parts;
}

Unparsable unparsable(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return {1, "it is UTF-16 text; save it as UTF-8"};
  }
  int line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view one = text.substr(begin, end - begin);
    if (one.find('\0') != one.npos)
      return {line,
              "it holds a NUL byte: it is not text, or text of another encoding; save it as UTF-8"};
    if (has_deep_key(one)) return {line, "a key of so many parts cannot be meant"};
    begin = end + 1;
  }
  return {};
}

std::string toml_hint(std::string_view text, int line) {
  const std::string_view found = line_of(text, line);
  const auto equals = std::min(found.find('='), found.size());
  const auto begin = std::min(found.find_first_not_of("= \t", equals), found.size());
  const std::string value(found.substr(begin, 200));
  for (const Slip& slip : slips) {
    if (std::regex_search(value, std::regex(slip.value), std::regex_constants::match_continuous)) {
      return fmt::format(" ({})", slip.remedy);
    }
  }
  return {};
}

}  // namespace barchan
