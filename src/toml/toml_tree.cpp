// Parser of TOML: the only file that includes toml++, which is heavy to compile.
#include "src/toml/toml_tree.hpp"

#include <algorithm>
#include <charconv>
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
      NodeTable table;
      for (const auto& [key, value] : node) {
        // The key's line, not the value's: that is where a reader looks, and a table made by a
        // dotted header has no line of its own.
        Location here = where;
        if (here.line != 0) here.line = static_cast<int>(key.source().begin.line);
        table.emplace(key.str(), convert(value, here));
      }
      to.value = std::move(table);
    } else if constexpr (toml::is_array<Kind>) {
      NodeArray elements;
      for (const auto& element : node) {
        Location here = where;  // each [[section]] has a line of its own
        if (here.line != 0 && element.is_table())
          here.line = static_cast<int>(element.source().begin.line);
        elements.push_back(convert(element, here));
      }
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

constexpr int kMaxParts = 16;  // parts of a dotted key; ours have four

/// Rest of `text` after the string or comment that it begins with, by the grammar of TOML 1.0; all
/// of it, if it begins with none.
std::string_view after_string(std::string_view text) {
  const char quote = text.front();
  if (quote != '#' && quote != '"' && quote != '\'') return text;
  const std::size_t line = std::min(text.find('\n'), text.size());
  if (quote == '#') return text.substr(line);
  const bool many_lines = text.starts_with(quote == '"' ? "\"\"\"" : "'''");
  const std::string end(many_lines ? 3 : 1, quote);
  const std::size_t last = many_lines ? text.size() : line;
  for (std::size_t at = end.size(); at < last; ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (text.substr(at).starts_with(end)) {
      at += end.size();
      for (int more = 0; many_lines && more < 2 && text.substr(at).starts_with(quote); ++more) ++at;
      return text.substr(at);
    }
  }
  return text.substr(last);
}

/// Problem that keeps `text`, which stands in `name`, from the parser: bytes that are no text, or
/// names nested so deep that they could only exhaust the stack.
std::optional<Problem> unfit(std::string_view text, const std::string& name) {
  const auto problem_at = [&](std::string_view rest, const char* what) {
    const auto before = text.substr(0, text.size() - rest.size());
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    return Problem{{name, static_cast<int>(line)}, fmt::format("not TOML: {}", what)};
  };
  if (const std::size_t nul = text.find('\0'); nul != text.npos)
    return problem_at(text.substr(nul),
                      "it holds a NUL byte: it is not text, or text of another encoding; save it "
                      "as UTF-8");
  int points = 0;  // points in a row that join parts of a key
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view behind = after_string(rest);
    if (behind.size() < rest.size()) {
      rest = behind;
      continue;
    }
    const char c = rest.front();
    if (c == '.' && ++points >= kMaxParts)
      return problem_at(rest, "a key of so many parts cannot be meant");
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') points = 0;
    rest.remove_prefix(1);
  }
  return {};
}

/// Message of the parser, with the two most frequent causes named.
std::string in_plain_words(std::string_view said) {
  if (said.find("control characters other than TAB") != said.npos)
    return "the quotation mark that ends a text is missing on this line";
  const char* cause = said.ends_with("saw ','") ? "; decimals take a point, as in 0.25" : "";
  return fmt::format("{}{}", said, cause);
}

/// Value of an assignment: TOML if it is, else a string of its characters.
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

/// Entry of a table by its name, or of a list by its number; nullptr if there is none.
template <class AnyNode>  // const or not
AnyNode* entry(AnyNode& of, std::string_view name) {
  if (auto* entries = of.table()) {
    const auto at = entries->find(name);
    return at == entries->end() ? nullptr : &at->second;
  }
  auto* const list = std::get_if<NodeArray>(&of.value);
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool whole = error == std::errc() && end == name.data() + name.size();
  return list != nullptr && whole && number - 1 < list->size() ? &(*list)[number - 1] : nullptr;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reason why `at`, the value of the key `above`, has no part `name`.
std::string no_part(const Node& at, std::string_view above, std::string_view name) {
  if (const auto* list = std::get_if<NodeArray>(&at.value)) {
    return fmt::format("\"{}\" has no entry {}: its entries have the numbers 1 to {}", above, name,
                       list->size());
  }
  return fmt::format("\"{}\" is not a section", above);
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

std::string to_string(const Location& where) {
  return where.line > 0 ? fmt::format("{}:{}", where.file, where.line) : where.file;
}

Node* Node::part(std::string_view name, const Location& made_at) {
  // initial.grains is a text or a section.
  if (std::get_if<std::string>(&value) != nullptr) *this = {NodeTable{}, made_at};
  NodeTable* const entries = table();
  if (entries == nullptr) return entry(*this, name);
  return &entries->try_emplace(std::string(name), Node{NodeTable{}, made_at}).first->second;
}

const Node* Node::find(std::string_view dotted) const {
  const std::size_t dot = std::min(dotted.find('.'), dotted.size());
  const Node* at = entry(*this, dotted.substr(0, dot));
  return at == nullptr || dot == dotted.size() ? at : at->find(dotted.substr(dot + 1));
}

Node parse_toml(std::string_view text, const std::string& name, std::vector<Problem>& problems) {
  const Location whole{name, 1};
  try {
    auto problem = unfit(text, name);
    if (!problem) return convert(toml::parse(text, name), whole);
    problems.push_back(std::move(*problem));
  } catch (const toml::parse_error& error) {
    problems.push_back({{name, static_cast<int>(error.source().begin.line)},
                        "not TOML: " + in_plain_words(error.description())});
  }
  return {NodeTable{}, whole};
}

std::string assigned_name(std::string_view dotted) {
  return fmt::format("--set {}", printable(dotted, 60));
}

void apply_override(Node& root, std::string_view assignment, std::vector<Problem>& problems) {
  const std::size_t equals = assignment.find('=');
  const std::string_view dotted = without_blanks(assignment.substr(0, equals));
  const Location where{assigned_name(dotted), 0};
  const auto refuse = [&](std::string why) { problems.push_back({where, std::move(why)}); };
  if (std::count(dotted.begin(), dotted.end(), '.') >= kMaxParts) {
    return refuse("unknown key: none has so many parts");
  }
  if (equals == assignment.npos || dotted.empty()) {
    return refuse("must have the form key=value, as in time.end=2.5");
  }
  Node* at = &root;
  for (std::size_t begin = 0; begin <= dotted.size();) {
    const std::size_t end = std::min(dotted.find('.', begin), dotted.size());
    const std::string_view key = dotted.substr(begin, end - begin);
    if (key.empty()) return refuse("a part of the key is empty");
    const bool of_list = end + 1 < dotted.size() && is_digit(dotted[end + 1]);
    if (of_list && at->table() != nullptr && entry(*at, key) == nullptr) {
      return refuse(fmt::format("the case has no list \"{0}\": give the whole, {0}=[...]",
                                dotted.substr(0, end)));
    }
    Node* const part = at->part(key, where);
    if (part == nullptr) return refuse(no_part(*at, dotted.substr(0, begin - 1), key));
    at = part;
    begin = end + 1;
  }
  *at = parse_value(without_blanks(assignment.substr(equals + 1)), where);
}

}  // namespace barchan
