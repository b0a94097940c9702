// Flags that tell where kernels run.
#pragma once

#include <Kokkos_Core.hpp>

namespace barchan {

/// True in a build in which the host plays a device: kernels have the shapes that they have there,
/// and the host has copies of its own of all arrays (docs/dev/reliability.md).
#ifdef BARCHAN_REHEARSAL
inline constexpr bool kRehearsal = true;
#else
inline constexpr bool kRehearsal = false;
#endif

/// True if kernels run on the host, in its memory.
inline constexpr bool kOnHost =
    !kRehearsal &&
    Kokkos::SpaceAccessibility<Kokkos::HostSpace,
                               Kokkos::DefaultExecutionSpace::memory_space>::accessible;

}  // namespace barchan
