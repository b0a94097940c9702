// The only file that includes toml++: it is heavy to compile.
#include "src/config/toml_tree.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "src/base/printable.hpp"
#include "src/config/toml_hint.hpp"

namespace barchan {
namespace {

Node convert(const toml::node& from, const Location& where);

NodeTable convert_table(const toml::table& from, const Location& where) {
  NodeTable to;
  for (const auto& [key, value] : from) {
    // The key's line, not the value's: that is where a reader looks, and a table made by a
    // dotted header has no line of its own.
    Location here = where;
    if (here.line != 0) here.line = static_cast<int>(key.source().begin.line);
    to.push_back({std::string(key.str()), convert(value, here)});
  }
  return to;
}

Node convert(const toml::node& from, const Location& where) {
  Node to;
  to.where = where;
  if (const auto* table = from.as_table()) {
    to.value = convert_table(*table, where);
  } else if (const auto* array = from.as_array()) {
    NodeArray elements;
    for (const auto& element : *array) elements.push_back(convert(element, where));
    to.value = std::move(elements);
  } else if (const auto* text = from.as_string()) {
    to.value = text->get();
  } else if (const auto* integer = from.as_integer()) {
    to.value = std::int64_t{integer->get()};
  } else if (const auto* number = from.as_floating_point()) {
    to.value = number->get();
  } else if (const auto* flag = from.as_boolean()) {
    to.value = flag->get();
  } else {
    std::ostringstream written;
    from.visit([&](const auto& date) {
      if constexpr (toml::is_chronological<decltype(date)>) written << date.get();
    });
    to.value = DateOrTime{written.str()};
  }
  return to;
}

/// The value part of an assignment: TOML if it is, else a string of its characters.
Node parse_value(std::string_view text, const Location& where) {
  const bool one_line = text.find('\n') == text.npos && unparsable(text).line == 0;
  try {
    const toml::table parsed = toml::parse(one_line ? "value = " + std::string(text) : "");
    if (parsed.size() == 1) return convert(*parsed.get("value"), where);
  } catch (const toml::parse_error&) {  // NOLINT(bugprone-empty-catch)
    // A bare word: --set fluid.turbulence=none.
  }
  Node word;
  word.where = where;
  word.value = std::string(text);
  return word;
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
  if (const Unparsable stop = unparsable(text); stop.line > 0) {
    problems.push_back({{name, stop.line}, fmt::format("not TOML: {}", stop.why)});
    return Node{NodeTable{}, whole};
  }
  try {
    return convert(toml::parse(text, name), whole);
  } catch (const toml::parse_error& error) {
    const Location where{name, static_cast<int>(error.source().begin.line)};
    problems.push_back(
        {where, fmt::format("not TOML: {}{}", error.description(), toml_hint(text, where.line))});
  }
  return Node{NodeTable{}, whole};
}

void apply_override(Node& root, std::string_view assignment, std::vector<Problem>& problems) {
  const std::size_t equals = assignment.find('=');
  const std::string_view dotted = assignment.substr(0, equals);
  const Location where{fmt::format("--set {}", printable(dotted, 60)), 0};
  if (is_too_deep(dotted)) {
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

std::string toml_quoted(std::string_view text) {
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

std::string toml_number(double value) {
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
  std::string operator()(double number) const { return toml_number(number); }
  std::string operator()(const std::string& text) const { return toml_quoted(text); }
  std::string operator()(const DateOrTime& date) const { return date.text; }
};

}  // namespace

std::string toml_text(const Node& node) {
  constexpr std::size_t longest = 60;
  const std::string text = std::visit(Printer{}, node.value);
  return text.size() <= longest ? text : text.substr(0, longest - 3) + "...";
}

}  // namespace barchan
