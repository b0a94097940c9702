// Questions of this room about case files, so that it need not know a key. The answers are defined
// in src/case.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace barchan {

struct Config;  // target of the keys
struct Section;
using Sections = std::vector<Section>;

/// Table of all keys.
const Sections& sections();

/// Case of defaults, without any section.
std::shared_ptr<Config> blank_config();

/// Keys that `word`, written in `section`, stands for in other programs, dotted, "a.b" or "a.b,
/// a.c"; empty: none known.
std::string_view keys_meant_by(std::string_view word, std::string_view section);

/// Reason why a key (`value` empty) or a value of a key, as TOML, no longer exists; empty if it
/// does, or never did.
std::string removal(std::string_view dotted, std::string_view value);

/// Key or section that makes a key without effect in this case, whatever its value; empty: none.
/// The key must be there.
std::string_view switched_off_by(const std::string& dotted, const Config& config);

}  // namespace barchan
