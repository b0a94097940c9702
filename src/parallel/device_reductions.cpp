#include "src/parallel/device_reductions.hpp"

#include "src/parallel/communicator.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

DeviceReductions::DeviceReductions(const char* label, std::size_t n)
    : on_device_(label, n), on_host_(mirror(on_device_)) {}

void DeviceReductions::combine(MPI_Comm ranks, int slot, int n, MPI_Op operation) const {
  if (rank_count(ranks) == 1) return;
  const auto slots = std::pair(slot, slot + n);
  const auto here = Kokkos::subview(on_device_, slots);
  const auto on_host = Kokkos::subview(on_host_, slots);
  Kokkos::deep_copy(on_host, here);
  all_reduce(ranks, std::span(on_host.data(), static_cast<std::size_t>(n)), operation);
  Kokkos::deep_copy(here, on_host);
}

}  // namespace barchan
