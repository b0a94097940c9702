// Command new: a case of one's own, its numbers by the rules of docs/choosing.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace barchan {

/// Answers of the user from which a case is made.
struct NewCase {
  std::filesystem::path name;       // file of the case; ".toml" may be left out
  std::string diameter = "0.2 mm";  // mean of the grains, a length
  int grains = 3000;
  double density = 2500;                           // density of the grains [kg/m3]
  std::optional<double> velocity = {};             // [m/s]; empty: one that moves these grains well
  std::optional<std::filesystem::path> from = {};  // a case to be based on, instead of all this
};

/// Writes the case and the two that it starts from, or the one case based on `from`, checks them,
/// and says what to do next. Throws InputError: nothing is written then.
std::string make_new_case(const NewCase& asked);

}  // namespace barchan
