// Two restart files that hold the same state.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "src/io/hdf5_file.hpp"

namespace barchan::test {

inline std::string bits_of(const Hdf5File& file, const std::string& name) {
  const auto bits = [](const auto& numbers) {
    return std::string(reinterpret_cast<const char*>(numbers.data()),
                       numbers.size() * sizeof(numbers[0]));
  };
  if (file.info(name).type == ElementType::float64) return bits(file.read<double>(name));
  return bits(file.read<std::int64_t>(name));
}

/// Every stored array is the same, to the bit.
inline void expect_same_state(const std::filesystem::path& a, const std::filesystem::path& b) {
  const Hdf5File first(a, Hdf5File::Mode::read), second(b, Hdf5File::Mode::read);
  int n = 0;
  for (const std::string group :
       {"/", "/fluid/", "/grains/", "/contacts/", "/statistics/", "/feed/"}) {
    if (!first.exists(group)) continue;
    for (const std::string& child : first.children(group)) {
      const std::string name = group + child;
      if (first.is_group(name)) continue;
      EXPECT_TRUE(bits_of(first, name) == bits_of(second, name)) << name;
      ++n;
    }
  }
  EXPECT_GT(n, first.exists("/grains/") && first.exists("/fluid/") ? 20 : 14);
}

}  // namespace barchan::test
