// What the arrays of result files are, in words: their attribute "long_name".
#pragma once

#include <string>
#include <string_view>

#include "src/io/hdf5_file.hpp"

namespace barchan {

enum class Arrays { grains, flow, grid };

/// The words for an array by the last part of its name; empty if there are none.
std::string_view long_name(Arrays kind, std::string_view name);

/// Writes an array as Hdf5File::write does, with its long name.
template <class T>
void write_named(Hdf5File& file, Arrays kind, const std::string& name, std::span<const T> values,
                 const Extents& extents, std::string_view units, const Hyperslab& slab = {}) {
  file.write(name, values, extents, units, slab);
  file.set_attribute(name, "long_name", long_name(kind, name));
}

}  // namespace barchan
