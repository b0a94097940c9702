#include "perf/events.hpp"

#include <Kokkos_Core.hpp>
#include <chrono>
#include <cstring>

namespace barchan {

namespace {

namespace tools = Kokkos::Tools::Experimental;
using Space = Kokkos_Profiling_SpaceHandle;
using Clock = std::chrono::steady_clock;

// Kokkos calls bare functions, hence the globals.
constexpr const char* kRebuildRegion = "list rebuild";  // as in src/grains/neighbor_list.cpp
EventCounts events;
bool counting = false;
std::int64_t bytes_alive = 0;
std::vector<bool> regions;  // open ones, innermost last: is it a rebuild
int open_rebuilds = 0;

void on_push(const char* name) {
  regions.push_back(std::strcmp(name, kRebuildRegion) == 0);
  open_rebuilds += regions.back() ? 1 : 0;
}

void on_pop() {
  if (regions.empty()) return;  // opened before counting began
  open_rebuilds -= regions.back() ? 1 : 0;
  regions.pop_back();
}

void on_allocation(const Space, const char* label, const void*, const std::uint64_t size) {
  bytes_alive += static_cast<std::int64_t>(size);
  if (!counting) return;
  ++(open_rebuilds > 0 ? events.allocations_in_rebuild : events.allocations);
  ++events.allocated[(open_rebuilds > 0 ? "rebuild: " : "") + std::string(label)];
}

void on_deallocation(const Space, const char*, const void*, const std::uint64_t size) {
  bytes_alive -= static_cast<std::int64_t>(size);
}

bool is_fill(const char* source) {  // Kokkos' name for the source of a fill with one value
  return std::strcmp(source, "Scalar") == 0 || std::strcmp(source, "(none)") == 0;
}

void on_copy(Space to, const char* target, const void*, Space from, const char* source, const void*,
             std::uint64_t) {
  if (is_fill(source)) return;
  ++events.deep_copies;
  const auto on_host = [](const Space& space) {
    return std::strcmp(space.name, Kokkos::HostSpace::name()) == 0;
  };
  if (on_host(to) == on_host(from)) return;
  ++events.host_copies;
  ++events.copied[target];
}

struct Watched {
  std::string label;
  std::int64_t calls = 0;
};
std::vector<Watched> watched;
double watched_seconds = 0;
bool is_watched = false;
// NOLINTNEXTLINE(bugprone-throwing-static-initialization): made of a number, while compiling
Clock::time_point started;

void on_begin(const char* name, const std::uint32_t, std::uint64_t* id) {
  *id = 0;
  is_watched = false;
  for (Watched& w : watched) {
    if (w.label != name) continue;
    ++w.calls;
    is_watched = true;
  }
  started = Clock::now();
}

void on_end(std::uint64_t) {
  if (!is_watched) return;
  watched_seconds += std::chrono::duration<double>(Clock::now() - started).count();
  is_watched = false;
}

void watch_kernels(decltype(&on_begin) begin, decltype(&on_end) end) {
  tools::set_begin_parallel_for_callback(begin);
  tools::set_begin_parallel_reduce_callback(begin);
  tools::set_begin_parallel_scan_callback(begin);
  tools::set_end_parallel_for_callback(end);
  tools::set_end_parallel_reduce_callback(end);
  tools::set_end_parallel_scan_callback(end);
}

}  // namespace

void watch_arrays() {
  tools::set_allocate_data_callback(on_allocation);
  tools::set_deallocate_data_callback(on_deallocation);
}

std::int64_t array_bytes() { return bytes_alive; }

EventCounter::EventCounter() {
  counting = true;
  events = {};
  regions.clear();
  open_rebuilds = 0;
  tools::set_push_region_callback(on_push);
  tools::set_pop_region_callback(on_pop);
  tools::set_begin_deep_copy_callback(on_copy);
}

EventCounter::~EventCounter() {
  counting = false;
  tools::set_push_region_callback(nullptr);
  tools::set_pop_region_callback(nullptr);
  tools::set_begin_deep_copy_callback(nullptr);
}

const EventCounts& EventCounter::counts() const { return events; }

KernelClock::KernelClock(const std::vector<std::string>& labels) {
  watched.clear();
  for (const std::string& label : labels) watched.push_back({label});
  watched_seconds = 0;
  watch_kernels(on_begin, on_end);
}

KernelClock::~KernelClock() { watch_kernels(nullptr, nullptr); }

double KernelClock::take() {
  const double seconds = watched_seconds;
  watched_seconds = 0;
  return seconds;
}

std::string KernelClock::missing() const {
  for (const Watched& w : watched) {
    if (w.calls == 0) return w.label;
  }
  return {};
}

}  // namespace barchan
