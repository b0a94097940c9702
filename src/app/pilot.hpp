// Timing of the parts of a run on a short stretch of it.
#pragma once

#include "src/case/config.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Wall seconds of each part, for all cells and all grains of the case.
struct PartSeconds {
  double flow = 0, pressure = 0;  // in a fluid step
  double iterations = 0;          // iterations of the pressure equation in a fluid step
  double exchange = 0;            // gather and deposit in a fluid step
  double grain_step = 0;          // in a grain step of grains at rest
  double rebuild = 0;             // a new neighbour list
  double state_checks = 0;        // in a fluid step
  double dunes = 0;               // finding the dunes once
  double sample = 0;              // a sample of [statistics]
};

/// Runs the case itself for about `budget` seconds: its mesh and steps, with `grains` at rest where
/// they are. A case of more than a million cells or 300,000 grains is cut to a slice across x,
/// which counts as often as it fits into the case. Uses the threads that Kokkos has; all ranks call
/// it together.
PartSeconds time_parts(const Config& config, const InitialGrains& grains, double budget);

}  // namespace barchan
