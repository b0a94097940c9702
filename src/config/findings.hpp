// What the checks of a configuration find.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace barchan {

using Keys = std::vector<std::string>;

/// Dotted `keys` the finding rests on, the one to point at first; `message` follows
/// "[section] key = value: ".
struct Finding {
  enum class Severity { error, warning } severity;
  Keys keys;
  std::string message;
};

struct Findings {
  std::vector<Finding> all;
  void error(Keys keys, std::string message) {
    all.push_back({Finding::Severity::error, std::move(keys), std::move(message)});
  }
  void warning(Keys keys, std::string message) {
    all.push_back({Finding::Severity::warning, std::move(keys), std::move(message)});
  }
};

}  // namespace barchan
