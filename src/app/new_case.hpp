// The command new: a case of one's own, its numbers by the rules of docs/choosing.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace barchan {

/// What the user asked for.
struct NewCase {
  std::filesystem::path name;       // of the case; ".toml" may be left out
  std::string diameter = "0.2 mm";  // mean of the grains, a length
  int grains = 3000;
  double density = 2500;                // [kg/m3] of the grains
  std::optional<double> velocity = {};  // [m/s]; none: that which moves these grains well
  std::optional<std::filesystem::path> from = {};  // a case to be based on, instead of all this
};

/// Writes the case and the two that it starts from, or the one case based on `from`, checks them,
/// and says what to do next. Throws InputError: nothing is written then.
std::string make_new_case(const NewCase& asked);

}  // namespace barchan
