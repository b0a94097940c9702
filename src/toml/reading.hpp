// Reading of TOML text into a Config by the table of keys, with all complaints about single keys.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/toml/toml_tree.hpp"
#include "src/toml/vocabulary.hpp"

namespace barchan {

struct Key;

/// Reader of one file, with the problems found in it.
class ConfigReader {
 public:
  /// Parses `text`, which stands in `file`.
  ConfigReader(std::string_view text, const std::filesystem::path& file,
               const Sections& table = sections());
  /// Takes over the keys of the cases in case.base, and of those that they are based on.
  void inherit();
  /// Applies "key=value" assignments in order, before anything is read.
  void set(const std::vector<std::string>& assignments);
  /// Replaces keys of earlier versions by those of today, and keeps a notice of each; defined, as
  /// vocabulary.hpp, where the keys are.
  void renew_old_keys();
  /// Leaves out keys that have no effect, where a later layer has switched them off: who sets
  /// contact_model need not delete the elastic constants. Layers: bases, the file, assignments.
  void drop_switched_off();

  /// Reads into a case of defaults; a value that cannot be read keeps its default and is a problem.
  /// Lengths in diameters, and values that are "auto", are still to be settled.
  void read(Config& config);
  /// Sets lengths that are in diameters, as given or by default. `diameter`: the d of the case [m];
  /// 0: not known, which is a problem where a length is given. `tell`: reports it.
  void settle_lengths(Config& config, double diameter, bool tell);
  /// Tells if the program is to choose the value of a key.
  bool is_automatic(const std::string& dotted) const;

  /// Reports a problem with a dotted key or a section, at the line where it was written, else that
  /// of its section, else the file as a whole: "[section] key = value: message".
  void report_conflict(const std::string& dotted, const std::string& message);
  /// Reports a conflict, after which the key is bad.
  void report_error(const std::string& dotted, const std::string& message);
  /// Tells if `dotted`, or the section it is in, could not be read as meant: nothing is to be
  /// concluded from its value.
  bool is_bad(const std::string& dotted) const;
  /// Tells if any key of the file could not be read as meant.
  bool has_bad_keys() const { return !bad_.empty(); }

  /// Folder that a path which is the value of a key starts from.
  std::filesystem::path folder_of(const std::string& dotted) const;

  const Node& tree() const { return tree_; }
  std::vector<Problem>& problems() { return problems_; }
  /// Keys of earlier versions, and how they are written today.
  const std::vector<Problem>& notices() const { return notices_; }

 private:
  struct LengthInDiameters {
    const Key* key;
    Node value;
    std::size_t entry;
  };

  Node with_bases(Node own, const std::filesystem::path& file,
                  std::vector<std::filesystem::path> chain);
  void add_base(Node& all, const Node& name, const std::filesystem::path& file,
                const std::vector<std::filesystem::path>& chain);
  void leave_out(Node& all, const Node& name);
  bool take_old_word(const char* key, std::span<const std::string_view> words, std::string& word);
  bool is_switched_off(const std::string& dotted, const std::string& by) const;
  void drop(const std::string& dotted);

  void read(const Section& section, Config& config);
  void read_value(const Key& key, const Node& value, Config& config, std::size_t entry);
  void mismatch(const Key& key, const Node* value, const Node* around, const std::string& message);
  void read_list(const Section& section, const Node& node, Config& config);
  void read_keys(const Section& section, const Node& table, Config& config, std::size_t entry);
  void report_at(const Node* node, const Node* around, const std::string& dotted,
                 const std::string& message);
  Problem problem(const Location& where, const std::string& dotted, bool is_section,
                  const Node* node, const std::string& message) const;
  void add_problem(const Location& where, const std::string& dotted, bool is_section,
                   const Node* node, const std::string& message) {
    problems_.push_back(problem(where, dotted, is_section, node, message));
  }
  int layer_of(const Node* node) const;
  std::vector<std::string> names_in(const std::string& path) const;
  bool is_section(const std::string& dotted) const;
  void find_unknown(const std::string& section, const Node& node,
                    const std::vector<std::string>& known);
  std::string hint(const std::string& section, std::string_view keys);
  std::string suggestion(const std::string& section, const std::string& name, bool table);

  const Sections& table_;
  std::filesystem::path file_;
  std::vector<Problem> problems_, notices_;
  Node tree_;
  std::set<std::string> bad_;  // dotted keys and sections
  std::vector<LengthInDiameters> in_diameters_;
  int unknown_ = 0;
};

}  // namespace barchan
