// Findings of the checks of a case.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace barchan {

/// Finding about the dotted `keys`, the one to point at first; `message` follows "[section] key =
/// value: ".
struct Finding {
  enum class Severity { error, warning } severity;
  std::vector<std::string> keys;
  std::string message;
};

using KeyNames = std::vector<std::string>;

struct Findings {
  std::vector<Finding> all;

  /// Adds a finding if a condition holds, and says whether it does.
  template <class... Args>
  bool error_if(bool wrong, const KeyNames& keys, fmt::format_string<Args...> message,
                Args&&... args) {
    using enum Finding::Severity;
    if (wrong) all.push_back({error, keys, fmt::format(message, std::forward<Args>(args)...)});
    return wrong;
  }
  template <class... Args>
  bool warning_if(bool unwise, const KeyNames& keys, fmt::format_string<Args...> message,
                  Args&&... args) {
    using enum Finding::Severity;
    if (unwise) all.push_back({warning, keys, fmt::format(message, std::forward<Args>(args)...)});
    return unwise;
  }
  /// Adds an error if `value` is above `most`, a warning if only above `wise`; true for an error.
  bool limit(double value, double wise, double most, const KeyNames& keys, const std::string& error,
             const std::string& warning) {
    if (error_if(value > most, keys, "{}", error)) return true;
    warning_if(value > wise, keys, "{}", warning);
    return false;
  }
};

}  // namespace barchan
