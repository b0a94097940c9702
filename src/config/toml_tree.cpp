// The only file that includes toml++: it is heavy to compile.
#include "src/config/toml_tree.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "src/base/words.hpp"

namespace barchan {
namespace {

Node convert(const toml::node& from, const Location& where) {
  Node to{{}, where};
  from.visit([&](const auto& node) {
    using Kind = decltype(node);
    if constexpr (toml::is_table<Kind>) {
      NodeTable entries;
      for (const auto& [key, value] : node) {
        // The key's line, not the value's: that is where a reader looks, and a table made by a
        // dotted header has no line of its own.
        Location here = where;
        if (here.line != 0) here.line = static_cast<int>(key.source().begin.line);
        entries.push_back({std::string(key.str()), convert(value, here)});
      }
      to.value = std::move(entries);
    } else if constexpr (toml::is_array<Kind>) {
      NodeArray elements;
      for (const auto& element : node) elements.push_back(convert(element, where));
      to.value = std::move(elements);
    } else if constexpr (toml::is_chronological<Kind>) {
      std::ostringstream written;
      written << node.get();
      to.value = DateOrTime{written.str()};
    } else {
      to.value = node.get();
    }
  });
  return to;
}

constexpr int most_parts = 16;  // of a dotted key; ours have four

/// What keeps `text`, which stands in `name`, from the parser: bytes that are no text, or names
/// nested so deep that they could only exhaust the stack.
std::optional<Problem> unfit(std::string_view text, const std::string& name) {
  int line = 1, points = 0;  // points in a row that join parts of a key, in this line
  char until = 0;            // the end of a string or a comment
  for (const char c : text) {
    if (c == '\0') {
      return Problem{{name, line},
                     "not TOML: it holds a NUL byte: it is not text, or text of another encoding; "
                     "save it as UTF-8"};
    }
    if (c == '\n') {
      ++line;
      points = 0;
      until = 0;
    } else if (until != 0) {
      if (c == until) until = 0;
    } else if (c == '"' || c == '\'' || c == '#') {
      until = c == '#' ? '\n' : c;
    } else if (c == '=' || c == ',' || c == '[' || c == '{') {
      points = 0;
    } else if (c == '.' && ++points >= most_parts) {
      return Problem{{name, line}, "not TOML: a key of so many parts cannot be meant"};
    }
  }
  return {};
}

/// The value part of an assignment: TOML if it is, else a string of its characters.
Node parse_value(std::string_view text, const Location& where) {
  const bool one_line = text.find('\n') == text.npos && !unfit(text, {});
  try {
    const toml::table parsed = toml::parse(one_line ? "value = " + std::string(text) : "");
    if (parsed.size() == 1) return convert(*parsed.get("value"), where);
  } catch (const toml::parse_error&) {  // NOLINT(bugprone-empty-catch)
    // A bare word: --set fluid.turbulence=none.
  }
  return {std::string(text), where};
}

Node& find_or_add(NodeTable& table, std::string_view key, const Location& where) {
  const auto at = std::find_if(table.begin(), table.end(),
                               [&](const Entry& entry) { return entry.key == key; });
  if (at != table.end()) return at->node;
  table.push_back({std::string(key), Node{NodeTable{}, where}});
  return table.back().node;
}

}  // namespace

std::string to_string(const Location& where) {
  return where.line > 0 ? fmt::format("{}:{}", where.file, where.line) : where.file;
}

const Node* Node::find(std::string_view dotted) const {
  const NodeTable* entries = table();
  if (entries == nullptr) return nullptr;
  const std::size_t dot = std::min(dotted.find('.'), dotted.size());
  for (const auto& [name, node] : *entries) {
    if (name != dotted.substr(0, dot)) continue;
    return dot == dotted.size() ? &node : node.find(dotted.substr(dot + 1));
  }
  return nullptr;
}

Node parse_toml(std::string_view text, const std::string& name, std::vector<Problem>& problems) {
  const Location whole{name, 1};
  try {
    auto problem = unfit(text, name);
    if (!problem) return convert(toml::parse(text, name), whole);
    problems.push_back(std::move(*problem));
  } catch (const toml::parse_error& error) {
    problems.push_back({{name, static_cast<int>(error.source().begin.line)},
                        fmt::format("not TOML: {}", error.description())});
  }
  return {NodeTable{}, whole};
}

void apply_override(Node& root, std::string_view assignment, std::vector<Problem>& problems) {
  const std::size_t equals = assignment.find('=');
  const std::string_view dotted = assignment.substr(0, equals);
  const Location where{fmt::format("--set {}", printable(dotted, 60)), 0};
  if (std::count(dotted.begin(), dotted.end(), '.') >= most_parts) {
    problems.push_back({where, "unknown key: none has so many parts"});
    return;
  }
  if (equals == assignment.npos || dotted.empty()) {
    problems.push_back({where, "must have the form key=value, as in time.end=2.5"});
    return;
  }
  Node* at = &root;
  for (std::size_t begin = 0; begin <= dotted.size();) {
    const std::size_t end = std::min(dotted.find('.', begin), dotted.size());
    const std::string_view key = dotted.substr(begin, end - begin);
    if (key.empty() || at->table() == nullptr) {
      problems.push_back({where, key.empty() ? std::string("a part of the key is empty")
                                             : fmt::format("\"{}\" is not a section",
                                                           dotted.substr(0, begin - 1))});
      return;
    }
    at = &find_or_add(*at->table(), key, where);
    begin = end + 1;
  }
  *at = parse_value(assignment.substr(equals + 1), where);
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += fmt::format("\\u{:04X}", static_cast<int>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string toml_text(double value) {
  std::string text = fmt::format("{}", value);
  // Only digits and a sign: an integer to TOML. (inf and nan stay as they are.)
  if (text.find_first_not_of("-0123456789") == text.npos) text += ".0";
  return text;
}

namespace {

struct Printer {
  std::string operator()(const NodeTable& table) const {
    std::string text;
    for (const auto& [key, node] : table) {
      text +=
          fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, std::visit(*this, node.value));
    }
    return "{ " + text + " }";
  }
  std::string operator()(const NodeArray& array) const {
    std::string text;
    for (const Node& node : array) {
      text += fmt::format("{}{}", text.empty() ? "" : ", ", std::visit(*this, node.value));
    }
    return "[" + text + "]";
  }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(std::int64_t number) const { return std::to_string(number); }
  std::string operator()(double number) const { return toml_text(number); }
  std::string operator()(const std::string& text) const { return toml_text(text); }
  std::string operator()(const DateOrTime& date) const { return date.text; }
};

}  // namespace

std::string toml_text(const Node& node) {
  constexpr std::size_t longest = 60;
  const std::string text = std::visit(Printer{}, node.value);
  return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

}  // namespace barchan
