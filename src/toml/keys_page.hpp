// Table of keys for readers: docs/keys.md, and the terminal.
#pragma once

#include <string>
#include <string_view>

#include "src/toml/keys.hpp"

namespace barchan {

/// Configuration of defaults, with every section there and an entry in those that may be written
/// many times.
std::shared_ptr<const Config> with_every_section(const Sections& table);

/// Head of a section as it stands in a file, "[grains]".
std::string title_of(const Section& section);

/// Text of docs/keys.md: a table of the keys of each section with range, unit, default and meaning.
std::string keys_page(const Sections& table = sections());

/// Keys of the section `name`, or the key of that dotted name, for a terminal: lines of at most 100
/// characters. Throws InputError with the nearest name if there is none.
std::string keys_text(std::string_view name, const Sections& table = sections());

}  // namespace barchan
