// Times the parts of a run on a short stretch of it.
#pragma once

#include "src/case/config.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Wall seconds of each part, of all cells and all grains of the case.
struct PartSeconds {
  double flow = 0, pressure = 0;  // a fluid step
  double iterations = 0;          // of the pressure equation in it
  double exchange = 0;            // a fluid step: gather and deposit
  double grain_step = 0;          // a grain step of grains at rest
  double rebuild = 0;             // a new neighbour list
  double state_checks = 0;        // a fluid step
  double dunes = 0;               // finding the dunes once
  double sample = 0;              // of [statistics], once
};

/// Runs the case itself for about `budget` seconds: its mesh and steps, with `grains` at rest where
/// they are. Of more than a million cells or 300,000 grains it takes a slice across x and counts it
/// as often as it fits into the case. On the threads that Kokkos has; all ranks together.
PartSeconds time_parts(const Config& config, const InitialGrains& grains, double budget);

}  // namespace barchan
