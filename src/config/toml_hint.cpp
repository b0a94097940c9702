#include "src/config/toml_hint.hpp"

#include <algorithm>
#include <cctype>

namespace barchan {

namespace {

constexpr int most_parts = 16;  // ours have four

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::string_view line_of(std::string_view text, int line) {
  for (; line > 1; --line) {
    const auto end = text.find('\n');
    if (end == text.npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
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

/// A number that is one elsewhere: 0,5 or 5d-6 or .5 or 5. or a unit behind it.
std::string number_hint(std::string_view value) {
  const auto digits_end = std::find_if(value.begin(), value.end(), [](char c) {
    return !is_digit(c) && c != '.' && c != '-' && c != '+';
  });
  const std::string_view rest(digits_end, value.end());
  const std::string_view digits(value.begin(), digits_end);
  const bool is_number = std::any_of(digits.begin(), digits.end(), is_digit);
  if (!is_number) return {};
  if (rest.size() > 1 && rest[0] == ',' && is_digit(rest[1])) {
    return " (decimals come after a point, not a comma)";
  }
  if (digits.find('.') != digits.npos && (digits.front() == '.' || digits.back() == '.')) {
    return " (a digit must stand on both sides of the point, as in 0.01)";
  }
  if (!rest.empty() && (rest[0] == 'd' || rest[0] == 'D')) {
    return " (exponents are written with e, as in 5e-6)";
  }
  const std::string_view unit = trimmed(rest);
  if (!unit.empty() && std::isalpha(static_cast<unsigned char>(unit[0])) != 0 && unit[0] != 'e' &&
      unit[0] != 'E' && unit[0] != 'x') {
    return " (numbers stand without a unit; all are SI)";
  }
  return {};
}

std::string value_hint(std::string_view value) {
  if (value.empty()) return {};
  if (value.front() == '"' && value.find('\\') != value.npos) {
    return " (a backslash in \"...\" begins an escape: write '...' or / instead)";
  }
  if (std::isalpha(static_cast<unsigned char>(value.front())) != 0) {
    return " (text stands in quotes; true and false are lower case)";
  }
  return number_hint(value);
}

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
  const auto equals = found.find('=');
  return equals == found.npos ? std::string() : value_hint(trimmed(found.substr(equals + 1)));
}

}  // namespace barchan
