// How many cores other programs keep busy.
#pragma once

#include <optional>
#include <string>

namespace barchan {

/// Processor time since some moment of the past [s].
struct ProcessorSeconds {
  double of_all = 0;  // of all programs, and what a host machine takes for others (steal)
  double own = 0;     // of this process, all threads
  double wall = 0;
};

/// The processor time of all programs, from the text of /proc/stat; nothing if it is none.
std::optional<double> seconds_of_all(const std::string& proc_stat, double ticks_per_second);

/// As of now; nothing where the system does not tell.
std::optional<ProcessorSeconds> processor_seconds();

/// Cores that others kept busy between two moments, in the mean.
double cores_of_others(const ProcessorSeconds& before, const ProcessorSeconds& after);

}  // namespace barchan
