// What the checks of a configuration gather.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "src/config_validate.hpp"

namespace barchan {

using Keys = std::vector<std::string>;

struct Findings {
  std::vector<Finding> all;
  void error(Keys keys, std::string message) {
    all.push_back({Finding::Severity::error, std::move(keys), std::move(message)});
  }
  void warning(Keys keys, std::string message) {
    all.push_back({Finding::Severity::warning, std::move(keys), std::move(message)});
  }
};

/// [initial] against the sections it belongs to, and a cone to pour against the domain.
void check_initial(const Config& c, Findings& found);

}  // namespace barchan
