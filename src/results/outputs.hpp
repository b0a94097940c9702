// Outputs of result files in words: a name, a unit and a meaning for each quantity.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "src/io/hdf5_file.hpp"

namespace barchan {

/// A column of a table, or an array of an HDF5 file, where `unit` and `meaning` are its attributes
/// "units" and "long_name".
struct Output {
  std::string name, unit, meaning;
};

/// A table for docs/files.md, which must hold this text.
std::string page_of(std::span<const Output> outputs, const std::string& heading);

/// Words for docs/files.md without their links, [words](page).
std::string without_links(std::string text);

/// Writes an array of a group, and what it is.
template <class T>
void write_output(Hdf5File& file, const std::string& group, const Output& about,
                  std::span<const T> values, const Extents& extents, const Hyperslab& slab = {}) {
  const std::string name = group + "/" + about.name;
  file.write(name, values, extents, about.unit, slab);
  file.set_attribute(name, "long_name", about.meaning);
}

}  // namespace barchan
