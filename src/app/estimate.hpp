// Estimate of how long a case will take on this machine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/app/pilot.hpp"
#include "src/app/starts.hpp"

namespace barchan {

/// Wall seconds of a whole run, by part.
struct RunSeconds {
  double flow = 0, exchange = 0, grains = 0, lists = 0, output = 0;
  double all() const { return flow + exchange + grains + lists + output; }
};

/// Wall seconds of a run of the case, from the times of its parts.
RunSeconds run_seconds(const SettledCase& the_case, const PartSeconds& parts);

/// Estimated number of new neighbour lists in a second of simulated time. The case must have sizes.
double rebuild_rate(const SettledCase& the_case);

/// Lines for a terminal: the time that the case takes on this machine, estimated from about a
/// second of timing, and the starts that are missing beside `folder`. `planned`: its grains. Kokkos
/// must run; all ranks call it together.
std::string estimate(const Case& the_case, const std::filesystem::path& folder,
                     const PlannedGrains& planned);

}  // namespace barchan
