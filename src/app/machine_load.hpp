// Load of the machine: cores that other programs keep busy.
#pragma once

#include <optional>
#include <string>

namespace barchan {

/// Processor time since some moment of the past [s].
struct ProcessorSeconds {
  double of_all = 0;  // time of all programs, and that which a host takes for others (steal)
  double own = 0;     // time of this process, all threads
  double wall = 0;
};

/// Processor time of all programs, from the text of /proc/stat; empty if it is another text.
std::optional<double> seconds_of_all(const std::string& proc_stat, double ticks_per_second);

/// Processor time until now; empty where the system does not tell.
std::optional<ProcessorSeconds> processor_seconds();

/// Mean number of cores that others kept busy between two moments.
double cores_of_others(const ProcessorSeconds& before, const ProcessorSeconds& after);

}  // namespace barchan
