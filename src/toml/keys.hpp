// Table of all keys of a configuration, for ConfigReader, checking, writing, the comparison with a
// restart and docs/keys.md.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "src/toml/form.hpp"
#include "src/toml/values.hpp"
#include "src/toml/vocabulary.hpp"

namespace barchan {

/// Word for a value that the program is to choose.
inline constexpr const char* kAutomatic = "auto";
/// Word for the default of a key that has none, in a section that is like another one.
inline constexpr const char* kNoDefault = "none";

struct Key {
  std::string section, name;
  std::string type;  // type in words
  Form form;         // type for programs
  Range range;
  std::string unit;     // unit of its numbers; empty: none
  std::string meaning;  // one line
  bool required = false;
  /// Default in words if it depends on the case: a length "3 d", kAutomatic, or words in brackets.
  /// Empty: the default of the member.
  std::string by_default = {};
  bool takes_diameters = false;   // a length, whose texts may be in mean grain diameters
  bool fixed_by_restart = false;  // the meaning of the numbers in a restart file depends on it

  /// Sets the member; returns what the value must be if it is not that, and then leaves the member
  /// alone. `entry`: which one, of a section that may be written many times.
  std::function<Mismatch(const Node&, Config&, std::size_t entry)> read;
  /// Value as TOML; empty if it, or its section, is absent.
  std::function<std::optional<std::string>(const Config&, std::size_t entry)> text;

  std::string dotted() const { return section + "." + name; }
};

struct Section {
  std::string name;  // dotted
  std::string meaning = {};
  bool required = false;  // has a required key and no meaning in its absence
  /// Name of the section whose keys are the defaults of this one's; empty: none.
  std::string like = {};
  /// Gives the section its defaults, if the file has it; called before its keys are read.
  std::function<void(Config&, bool in_file)> prepare = {};
  std::vector<Key> keys = {};

  /// Functions of a section that may be written many times, [[name]]: one adds an entry of defaults
  /// to its list; the others tell how many there are, and how many there may be.
  std::function<void(Config&)> append = {};
  std::function<std::size_t(const Config&)> count = {};
  std::size_t most = std::numeric_limits<std::size_t>::max();
  bool repeated() const { return append != nullptr; }
};

}  // namespace barchan
