// Slots of pairs under their second grains.
#pragma once

#include "kernels/grains/pair_list.hpp"

namespace barchan {

/// Registers each inter-chunk slot with its second one of n grains. `cursor`: memory for as many,
/// overwritten.
void register_second_grains(const PairList& list, int n, const Kokkos::View<int*>& cursor);

}  // namespace barchan
