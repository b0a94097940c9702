// [restart]: when a case writes restart files, and how many it keeps.
#pragma once

namespace barchan {

/// [restart]
struct RestartConfig {
  double interval = 0;         // simulated seconds, 0: off
  double wall_interval = 600;  // wall seconds, 0: off
  int keep = 2;
  bool operator==(const RestartConfig&) const = default;
};

}  // namespace barchan
