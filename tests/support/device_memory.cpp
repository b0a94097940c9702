// Linked into every program of the preset rehearsal: arrays of the device are out of the host's
// reach. They are poisoned for the address sanitizer but while a kernel, a fill or a copy runs. A
// host that reads or writes one ends with its file and line, as it would with a real device.
//
// What Kokkos allocates is of the device, but for mirrors ("..._mirror", from kernels' views by
// barchan::mirror()), arrays whose label says so ("host: ..."), and Kokkos' own ("Kokkos::...").
#include <sanitizer/asan_interface.h>

#include <Kokkos_Core.hpp>
#include <cstdint>
#include <map>
#include <mutex>
#include <string_view>

namespace {

namespace tools = Kokkos::Tools::Experimental;
using Space = Kokkos_Profiling_SpaceHandle;

struct DeviceMemory {
  std::mutex mutex;
  std::map<const char*, std::size_t> arrays;  // where they begin [bytes]
  int at_work = 0;                            // kernels, fills and copies that are running
};

/// Never destroyed: arrays may outlive what is static.
DeviceMemory& memory() {
  static auto& all = *new DeviceMemory;
  return all;
}

bool is_of_device(std::string_view label) {
  return !label.ends_with("_mirror") && !label.starts_with("host: ") &&
         !label.starts_with("Kokkos::");
}

void begin_work() {
  DeviceMemory& m = memory();
  const std::scoped_lock lock(m.mutex);
  if (m.at_work++ > 0) return;
  for (const auto& [begin, bytes] : m.arrays) ASAN_UNPOISON_MEMORY_REGION(begin, bytes);
}

void end_work() {
  DeviceMemory& m = memory();
  const std::scoped_lock lock(m.mutex);
  if (--m.at_work > 0) return;
  for (const auto& [begin, bytes] : m.arrays) ASAN_POISON_MEMORY_REGION(begin, bytes);
}

/// Kokkos' header of an allocation comes before its numbers.
const char* numbers_of(const void* allocation) {
  return static_cast<const char*>(allocation) + sizeof(Kokkos::Impl::SharedAllocationHeader);
}

void on_allocation(const Space, const char* label, const void* allocation,
                   const std::uint64_t bytes) {
  if (!is_of_device(label)) return;
  DeviceMemory& m = memory();
  const std::scoped_lock lock(m.mutex);
  m.arrays[numbers_of(allocation)] = bytes;
  if (m.at_work == 0) ASAN_POISON_MEMORY_REGION(numbers_of(allocation), bytes);
}

void on_deallocation(const Space, const char*, const void* allocation, const std::uint64_t) {
  DeviceMemory& m = memory();
  const std::scoped_lock lock(m.mutex);
  const auto array = m.arrays.find(numbers_of(allocation));
  if (array == m.arrays.end()) return;
  ASAN_UNPOISON_MEMORY_REGION(array->first, array->second);
  m.arrays.erase(array);
}

void begin_kernel(const char*, const std::uint32_t, std::uint64_t* id) {
  *id = 0;
  begin_work();
}
void end_kernel(std::uint64_t) { end_work(); }

void begin_copy(Space, const char*, const void*, Space, const char*, const void*, std::uint64_t) {
  begin_work();
}

const bool is_watching = [] {
  tools::set_allocate_data_callback(on_allocation);
  tools::set_deallocate_data_callback(on_deallocation);
  tools::set_begin_parallel_for_callback(begin_kernel);
  tools::set_begin_parallel_reduce_callback(begin_kernel);
  tools::set_begin_parallel_scan_callback(begin_kernel);
  tools::set_end_parallel_for_callback(end_kernel);
  tools::set_end_parallel_reduce_callback(end_kernel);
  tools::set_end_parallel_scan_callback(end_kernel);
  tools::set_begin_deep_copy_callback(begin_copy);
  tools::set_end_deep_copy_callback(end_work);
  return true;
}();

}  // namespace
