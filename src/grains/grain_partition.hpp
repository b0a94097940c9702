// Partition of the grains among ranks: pieces of the Morton curve through the x-z columns.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "kernels/grains/search_columns.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// Largest imbalance without a new cut: work of the busiest rank over the mean.
inline constexpr Real kWorstImbalance = 1.03;

/// Partition of the curve into pieces of equal work, one for each rank.
class GrainPartition {
 public:
  explicit GrainPartition(MPI_Comm ranks);

  /// Cuts anew if the imbalance is above kWorstImbalance, and above twice that which was left at
  /// the last cut (columns are not cut). A grain counts one, and one half for each side of a
  /// contact, which `contacts` holds under its grains (starts); moving a grain takes about as long
  /// as a contact. All ranks call it together.
  void balance(const GrainState& grains, const SearchColumns& columns,
               const Kokkos::View<const int*>& contacts);

  /// Restores the partition of a restart file: offsets() and imbalance_at_cut() of the ranks that
  /// wrote it.
  void restore(const std::vector<std::int64_t>& starts, Real imbalance_at_cut);
  std::vector<std::int64_t> offsets() const;

  GrainOwners owners() const { return {me_, start_}; }
  /// Place where this rank's columns begin.
  std::uint32_t origin() const { return on_host_(me_); }
  /// Imbalance at the last balance(), before its cut and after it.
  Real imbalance_before() const { return before_; }
  Real imbalance() const { return now_; }
  /// Imbalance that the last cut left: the next one waits for more.
  Real imbalance_at_cut() const { return at_cut_; }

 private:
  MPI_Comm ranks_;
  int me_ = 0, count_ = 1;
  Kokkos::View<std::uint32_t*> start_;
  Kokkos::View<std::uint32_t*>::host_mirror_type on_host_;
  Real before_ = 1, now_ = 1, at_cut_ = 1;
  bool has_cut_ = false;
};

}  // namespace barchan
