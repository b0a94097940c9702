// Wall time by phase of the step.
#pragma once

#include <Kokkos_Profiling_ScopedRegion.hpp>
#include <chrono>
#include <map>
#include <string>

#include "kernels/math/vec3.hpp"

namespace barchan {

using WallClock = std::chrono::steady_clock;

inline double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

/// Adds the time of its own life to a number of seconds.
class ScopedSeconds {
 public:
  explicit ScopedSeconds(double& seconds) : seconds_(seconds) {}
  ~ScopedSeconds() { seconds_ += seconds_since(start_); }
  ScopedSeconds(const ScopedSeconds&) = delete;
  ScopedSeconds& operator=(const ScopedSeconds&) = delete;

 private:
  double& seconds_;
  WallClock::time_point start_ = WallClock::now();
};

/// Seconds by phase since the run began.
using Phases = std::map<std::string, double>;

/// Adds the time of its own life to one phase; also a region for Kokkos' profiling tools. Kernels
/// that a device has not finished by then count as the time of the next phase that waits for it.
class PhaseTimer {
 public:
  PhaseTimer(Phases& phases, const char* name) : seconds_(phases[name]), region_(name) {}

 private:
  ScopedSeconds seconds_;
  Kokkos::Profiling::ScopedRegion region_;
};

}  // namespace barchan
