// Sums and maxima over the cells of this rank into a DeviceReductions, as in reduce.hpp, but
// without a wait, and not over ranks. `where`: a CellRange or a Region.
#pragma once

#include "src/parallel/device_reductions.hpp"
#include "src/parallel/reduce.hpp"
#include "src/parallel/region.hpp"

namespace barchan {

namespace launch_detail {

template <class Functor>
struct Work {
  CellRange range;
  Functor functor;
};
template <class Functor>
Work<Functor> work(const CellRange& range, const Functor& functor) {
  return {range, functor};
}
template <class Functor>
Work<Within<Functor>> work(const Region& region, const Functor& functor) {
  return {region.range(), {region.ref(), functor}};
}

template <template <class> class Reduce, class Functor, class Result>
void reduce(const char* label, const Work<Functor>& work, const Result& result) {
  Kokkos::parallel_reduce(label, policy(work.range), Reduce<Functor>{work.functor, work.range},
                          result);
}

}  // namespace launch_detail

/// Sums functor(i, j, k) into one number.
template <class Where, class Functor>
void sum_each_cell(const char* label, const DeviceReductions& reductions, int slot,
                   const Where& where, const Functor& functor) {
  launch_detail::reduce<launch_detail::Sum>(label, launch_detail::work(where, functor),
                                            reductions.into(slot));
}
/// Sums the vectors functor(i, j, k) into three numbers.
template <class Where, class Functor>
void sum_vector(const char* label, const DeviceReductions& reductions, int slot, const Where& where,
                const Functor& functor) {
  launch_detail::reduce<launch_detail::VectorSum>(label, launch_detail::work(where, functor),
                                                  reductions.into<Vec3>(slot));
}
/// Finds the largest functor(i, j, k), for values that are not negative; infinity if one is not a
/// number.
template <class Where, class Functor>
void max_each_cell(const char* label, const DeviceReductions& reductions, int slot,
                   const Where& where, const Functor& functor) {
  launch_detail::reduce<launch_detail::Largest>(label, launch_detail::work(where, functor),
                                                reductions.largest_into(slot));
}
/// Reduces functors that return LargestAndSums into three numbers.
template <class Where, class Functor>
void largest_and_sums(const char* label, const DeviceReductions& reductions, int slot,
                      const Where& where, const Functor& functor) {
  launch_detail::reduce<launch_detail::MaxAndSum>(label, launch_detail::work(where, functor),
                                                  reductions.into<LargestAndSums>(slot));
}

}  // namespace barchan
