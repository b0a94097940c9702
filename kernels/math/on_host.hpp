// Where kernels run.
#pragma once

#include <Kokkos_Core.hpp>

namespace barchan {

/// Whether kernels run on the host, in its memory.
inline constexpr bool kOnHost =
    Kokkos::SpaceAccessibility<Kokkos::HostSpace,
                               Kokkos::DefaultExecutionSpace::memory_space>::accessible;

}  // namespace barchan
