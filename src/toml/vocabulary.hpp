// What the program says of its case files, so that this room need not know a key of theirs. It is
// defined in src/case.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace barchan {

struct Config;  // what the keys are read into
struct Section;
using Sections = std::vector<Section>;

/// The table of all keys.
const Sections& sections();

/// A case of defaults, without any section.
std::shared_ptr<Config> blank_config();

/// The keys that `word`, written in `section`, stands for in other programs, dotted, "a.b" or "a.b,
/// a.c"; empty: none known.
std::string_view keys_meant_by(std::string_view word, std::string_view section);

/// Why a key (`value` empty) or a value of a key, as TOML, is no longer there; empty if it is, or
/// never was.
std::string removal(std::string_view dotted, std::string_view value);

/// The key or section by which a key, which must be there, can do nothing in this case, whatever
/// its value; empty: it can.
std::string_view switched_off_by(const std::string& dotted, const Config& config);

}  // namespace barchan
