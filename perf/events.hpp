// Events that Kokkos reports to its tools, counted and timed inside the benchmark program.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace barchan {

struct EventCounts {
  std::int64_t allocations = 0;             // of views, outside list rebuilds
  std::int64_t allocations_in_rebuild = 0;  // inside them
  std::int64_t host_copies = 0;  // arrays that crossed between host and device, either way
  std::int64_t deep_copies = 0;  // all copies of arrays; not fills with one value
  std::map<std::string, std::int64_t> allocated;  // by label; "rebuild: " before those inside
  std::map<std::string, std::int64_t> copied;     // host copies by label
};

/// Keeps account of the memory of all views from now on.
void watch_arrays();
/// Memory of the views that are alive [bytes].
std::int64_t array_bytes();

/// Counts events while it lives; after watch_arrays(). One at a time, and no KernelClock beside it.
class EventCounter {
 public:
  EventCounter();
  ~EventCounter();
  EventCounter(const EventCounter&) = delete;
  EventCounter& operator=(const EventCounter&) = delete;
  const EventCounts& counts() const;
};

/// Times the kernels of the given labels while it lives, wherever they are launched. Kokkos fences
/// before and after every kernel meanwhile, so that asynchronous ones are timed, too.
class KernelClock {
 public:
  explicit KernelClock(const std::vector<std::string>& labels);
  ~KernelClock();
  KernelClock(const KernelClock&) = delete;
  KernelClock& operator=(const KernelClock&) = delete;
  /// Seconds since the last call.
  double take();
  /// Label that no kernel had so far; empty when all were met.
  std::string missing() const;
};

}  // namespace barchan
