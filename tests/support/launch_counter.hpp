// Counts what the host asks of a device: kernels to launch, and waits.
#pragma once

#include <Kokkos_Core.hpp>
#include <map>
#include <string>
#include <string_view>

namespace barchan::test {

/// Counts while it lives, one at a time. Tools that listen already hear everything, too. A wait is
/// a fence, or a copy or fill that ends with one; what Kokkos does at the creation of arrays counts
/// as its kernels and fences do.
class LaunchCounter {
 public:
  LaunchCounter() : before_(Kokkos::Tools::Experimental::get_callbacks()) {
    now() = this;
    namespace tools = Kokkos::Tools::Experimental;
    tools::set_begin_parallel_for_callback(
        [](const char* name, std::uint32_t device, std::uint64_t* id) {
          launched(name, device, id, now()->before_.begin_parallel_for);
        });
    tools::set_begin_parallel_reduce_callback(
        [](const char* name, std::uint32_t device, std::uint64_t* id) {
          launched(name, device, id, now()->before_.begin_parallel_reduce);
        });
    tools::set_begin_parallel_scan_callback(
        [](const char* name, std::uint32_t device, std::uint64_t* id) {
          launched(name, device, id, now()->before_.begin_parallel_scan);
        });
    tools::set_begin_fence_callback([](const char* name, std::uint32_t, std::uint64_t*) {
      const std::string_view why(name);
      if (why.starts_with("Kokkos::Tools")) return;         // because of this counter
      if (why.starts_with("Kokkos::DefaultGraph")) return;  // what stands in for a device's graph
      ++(now()->copies_ > 0 ? now()->fences_in_copy_ : now()->waits_[name]);
    });
    tools::set_begin_deep_copy_callback([](Kokkos_Profiling_SpaceHandle to, const char* target,
                                           const void* a, Kokkos_Profiling_SpaceHandle from,
                                           const char* source, const void* b, std::uint64_t bytes) {
      if (now()->copies_++ == 0) now()->copy_ = std::string("copy to ") + target;
      if (const auto chained = now()->before_.begin_deep_copy)
        chained(to, target, a, from, source, b, bytes);
    });
    tools::set_end_deep_copy_callback([] {
      if (--now()->copies_ == 0 && now()->fences_in_copy_ > 0) ++now()->waits_[now()->copy_];
      if (now()->copies_ == 0) now()->fences_in_copy_ = 0;
      if (const auto chained = now()->before_.end_deep_copy) chained();
    });
  }
  ~LaunchCounter() {
    Kokkos::Tools::Experimental::set_callbacks(before_);
    now() = nullptr;
  }
  LaunchCounter(const LaunchCounter&) = delete;
  LaunchCounter& operator=(const LaunchCounter&) = delete;

  /// Launches by label.
  const std::map<std::string, int>& launches() const { return launches_; }
  const std::map<std::string, int>& waits() const { return waits_; }
  static int sum(const std::map<std::string, int>& counts) {
    int all = 0;
    for (const auto& [name, n] : counts) all += n;
    return all;
  }

 private:
  static LaunchCounter*& now() {
    static LaunchCounter* counter = nullptr;
    return counter;
  }
  template <class Callback>
  static void launched(const char* name, std::uint32_t device, std::uint64_t* id,
                       Callback chained) {
    *id = 0;
    ++now()->launches_[name];
    if (chained) chained(name, device, id);
  }

  Kokkos::Tools::Experimental::EventSet before_;
  std::map<std::string, int> launches_, waits_;
  int copies_ = 0, fences_in_copy_ = 0;
  std::string copy_;
};

}  // namespace barchan::test
