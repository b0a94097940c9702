// TOML document as a small tree that remembers where each value was written. It is not the tree of
// toml++, which nvcc cannot compile and only one file includes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace barchan {

/// Location of a value: a line of a file (line 0: the file as a whole), or "--set key".
struct Location {
  std::string file;
  int line = 0;
};

/// Text without the blanks before and after it.
std::string_view without_blanks(std::string_view text);

/// Location in words: "file.toml:14", or the file alone when there is no line.
std::string to_string(const Location& where);

struct Node;
using NodeArray = std::vector<Node>;
using NodeTable = std::map<std::string, Node, std::less<>>;
struct DateOrTime {  // no key of ours takes one; kept to say so
  std::string text;
};

struct Node {
  std::variant<NodeTable, bool, std::int64_t, double, std::string, NodeArray, DateOrTime> value;
  Location where;

  const NodeTable* table() const { return std::get_if<NodeTable>(&value); }
  NodeTable* table() { return std::get_if<NodeTable>(&value); }
  /// Value of a dotted key, "grains.wall", in this table; nullptr if there is none. Entries of
  /// arrays are counted from 1: "initial.heap.2.radius".
  const Node* find(std::string_view dotted) const;
  /// Entry of a table, made where there is none, or of an array, nullptr where there is none. A
  /// text gives way to a table.
  Node* part(std::string_view name, const Location& made_at);
};

/// Problem with the input of a user, at `where`.
struct Problem {
  Location where;
  std::string text;
};

/// Parses a document; `name` stands for the file in locations. On a syntax error the problem is
/// added and an empty table returned.
Node parse_toml(std::string_view text, const std::string& name, std::vector<Problem>& problems);

/// Name of an assignment in locations: "--set a.b".
std::string assigned_name(std::string_view dotted);

/// Applies "a.b=value" (as after --set) to the tree, creating tables on the way; "a.2.b=value" in
/// the second entry of the list a. The value is TOML; anything that is not (a bare word) is a
/// string. The value's location is "--set a.b".
void apply_override(Node& root, std::string_view assignment, std::vector<Problem>& problems);

}  // namespace barchan
