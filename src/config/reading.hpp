// From TOML text to a Config by the table of keys, with all complaints about single keys.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "src/config/config.hpp"
#include "src/config/toml_tree.hpp"

namespace barchan {

struct Section;
using Sections = std::vector<Section>;
const Sections& sections();

/// One file that is read, and what is wrong with it.
class ConfigReader {
 public:
  /// Parses `text`, which stands in `file`.
  ConfigReader(std::string_view text, const std::filesystem::path& file,
               const Sections& table = sections());
  /// Applies "key=value" assignments in order, before anything is read.
  void set(const std::vector<std::string>& assignments);

  /// The configuration; what cannot be read keeps its default and is a problem.
  Config read();

  /// A complaint about a dotted key or a section, at the line where it was written, else that of
  /// its section, else the file as a whole: "[section] key = value: message".
  void report_conflict(const std::string& dotted, const std::string& message);
  /// The same; the key is bad from then on.
  void report_error(const std::string& dotted, const std::string& message);
  /// True if `dotted`, or the section it is in, could not be read as meant: nothing is to be
  /// concluded from its value.
  bool is_bad(const std::string& dotted) const;
  /// True if any key that there is could not be read as meant.
  bool has_bad_keys() const { return !bad_.empty(); }

  /// True if a key was given by an assignment, not by the file.
  bool is_assigned(const std::string& dotted) const;
  /// As if a key were not there.
  void drop(const std::string& dotted);

  const Node& tree() const { return tree_; }
  std::vector<Problem>& problems() { return problems_; }

 private:
  void read(const Section& section, Config& config);
  void read_list(const Section& section, const Node& node, Config& config);
  void read_keys(const Section& section, const Node& table, Config& config, std::size_t entry);
  void report_at(const Node* node, const Node* around, const std::string& dotted,
                 const std::string& message);
  void add_problem(const Location& where, const std::string& dotted, bool is_section,
                   const Node* node, const std::string& message);
  std::vector<std::string> names_in(const std::string& path) const;
  bool is_section(const std::string& dotted) const;
  void find_unknown(const std::string& section, const Node& node,
                    const std::vector<std::string>& known);
  std::string hint(const std::string& section, std::string_view keys);
  std::string suggestion(const std::string& section, const std::string& name, bool table);

  const Sections& table_;
  std::filesystem::path file_;
  std::vector<Problem> problems_;
  Node tree_;
  std::set<std::string> bad_;  // dotted keys and sections
  int unknown_ = 0;
};

}  // namespace barchan
