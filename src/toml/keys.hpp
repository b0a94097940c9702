// The table of all keys of a configuration. ConfigReader, checking, writing, the comparison with a
// restart and docs/keys.md walk it.
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

/// The value of a key that the program is to choose.
inline constexpr const char* kAutomatic = "auto";

struct Key {
  std::string section, name;
  std::string type;  // in words
  Form form;         // the same for programs
  Range range;
  std::string unit;     // of its numbers; empty: none
  std::string meaning;  // one line
  bool required = false;
  /// What the reader takes where a case says nothing, if that rests on the case: a length "3 d",
  /// kAutomatic, or words in brackets. Else the default of the member.
  std::string by_default = {};
  bool takes_diameters = false;   // a length, whose texts may be in mean grain diameters
  bool fixed_by_restart = false;  // what the numbers of a restart file mean depends on it

  /// Sets the member; what the value must be if it is not that, the member is left alone then.
  /// `entry`: which one, of a section that may be written many times.
  std::function<Mismatch(const Node&, Config&, std::size_t entry)> read;
  /// The value as TOML; nothing if it, or its section, is absent.
  std::function<std::optional<std::string>(const Config&, std::size_t entry)> text;

  std::string dotted() const { return section + "." + name; }
};

struct Section {
  std::string name;  // dotted
  std::string meaning = {};
  bool required = false;  // with a required key and no meaning in its absence
  /// Of a section whose keys default to those of another one: its name.
  std::string like = {};
  /// Called before the keys are read: gives the section, if the file has it, its defaults.
  std::function<void(Config&, bool in_file)> prepare = {};
  std::vector<Key> keys = {};

  /// Of a section that may be written many times, [[name]]: adds an entry of defaults to its list;
  /// how many there are; how many there may be.
  std::function<void(Config&)> append = {};
  std::function<std::size_t(const Config&)> count = {};
  std::size_t most = std::numeric_limits<std::size_t>::max();
  bool repeated() const { return append != nullptr; }
};

}  // namespace barchan
