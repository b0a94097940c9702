#include "src/grains/grain_partition.hpp"

#include <algorithm>
#include <utility>

#include "src/base/report.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Place on the curve (upper half) and work (lower half) of each grain.
Kokkos::View<std::uint64_t*> work_at_places(const GrainState& grains, const SearchColumns& columns,
                                            const Kokkos::View<const int*>& contacts) {
  const Kokkos::View<std::uint64_t*> work("partition: work", static_cast<std::size_t>(grains.n));
  const PlaceOfGrain place{grains.kin, grains.clump};
  Kokkos::parallel_for(
      "partition: work", items(grains.n), KOKKOS_LAMBDA(int g) {
        const int sides = contacts(g + 1) - contacts(g);
        work(g) = (std::uint64_t{columns.morton_code_of(place(g))} << 32) |
                  static_cast<std::uint64_t>(2 + sides);
      });
  return work;
}

/// Work by code on the curve, of the grains of one rank.
class WorkAlongCurve {
 public:
  explicit WorkAlongCurve(const Kokkos::View<std::uint64_t*>& at_places) {
    const auto here = host_copy(at_places);
    grain_.assign(here.data(), here.data() + here.size());
    std::sort(grain_.begin(), grain_.end());
    for (const std::uint64_t grain : grain_)
      sum_.push_back(sum_.back() + static_cast<std::int64_t>(grain & 0xffffffffu));
  }
  std::int64_t total() const { return sum_.back(); }
  /// Work at the codes before this one.
  std::int64_t before(std::uint32_t code) const {
    const auto at = std::lower_bound(grain_.begin(), grain_.end(), std::uint64_t{code} << 32);
    return sum_[static_cast<std::size_t>(at - grain_.begin())];
  }

 private:
  std::vector<std::uint64_t> grain_;
  std::vector<std::int64_t> sum_{0};  // work of the grains before
};

/// Finds together, by bisection, where equal pieces of the work of all ranks begin. It works with
/// integers: the result is the same for any number of threads, and for any share of the grains
/// among the ranks before.
std::vector<std::int64_t> equal_pieces(MPI_Comm ranks, const WorkAlongCurve& work,
                                       std::int64_t total, int count) {
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::int64_t> low(n, 0), high(n, 0xffffffff), sum(n);
  for (int bit = 0; bit < 32; ++bit) {
    for (std::size_t r = 0; r < n; ++r)
      sum[r] = work.before(static_cast<std::uint32_t>((low[r] + high[r]) / 2));
    sum_over(ranks, sum);
    for (std::size_t r = 0; r < n; ++r) {
      const std::int64_t middle = (low[r] + high[r]) / 2;
      const bool enough = sum[r] * count >= total * static_cast<std::int64_t>(r);
      (enough ? high : low)[r] = middle;
    }
  }
  high[0] = 0;
  return high;
}

Real over_mean(Real largest, std::int64_t total, int count) {
  return total > 0 ? largest * count / static_cast<Real>(total) : 1;
}

}  // namespace

GrainPartition::GrainPartition(MPI_Comm ranks)
    : ranks_(ranks),
      me_(rank_of(ranks)),
      count_(rank_count(ranks)),
      start_("partition: starts", static_cast<std::size_t>(count_)),
      on_host_(mirror(start_)) {}

void GrainPartition::balance(const GrainState& grains, const SearchColumns& columns,
                             const Kokkos::View<const int*>& contacts) {
  int sides = 0;
  Kokkos::deep_copy(sides, Kokkos::subview(contacts, grains.n));
  const std::int64_t mine = 2 * std::int64_t{grains.n} + sides;
  const std::int64_t total = sum_over(ranks_, mine);
  before_ = now_ = over_mean(max_over(ranks_, static_cast<Real>(mine)), total, count_);
  const Real tolerable = std::max(kWorstImbalance, 1 + 2 * (at_cut_ - 1));
  if (has_cut_ && before_ <= tolerable) return;
  const bool again = has_cut_;
  const WorkAlongCurve work(work_at_places(grains, columns, contacts));
  restore(equal_pieces(ranks_, work, total, count_), at_cut_);
  std::vector<std::int64_t> piece;  // work that each rank will have, from here
  for (int r = 0; r < count_; ++r) {
    const std::int64_t end = r + 1 < count_ ? work.before(on_host_(r + 1)) : work.total();
    piece.push_back(end - work.before(on_host_(r)));
  }
  sum_over(ranks_, piece);
  now_ = at_cut_ =
      over_mean(static_cast<Real>(*std::max_element(piece.begin(), piece.end())), total, count_);
  if (again) {
    report::info(
        "grains redistributed among {} ranks: the busiest had {:.3f} of the mean work and has "
        "{:.3f}",
        count_, before_, now_);
  }
}

void GrainPartition::restore(const std::vector<std::int64_t>& starts, Real imbalance_at_cut) {
  for (int r = 0; r < count_; ++r)
    on_host_(r) = static_cast<std::uint32_t>(starts[static_cast<std::size_t>(r)]);
  Kokkos::deep_copy(start_, on_host_);
  at_cut_ = imbalance_at_cut;
  has_cut_ = true;
}

std::vector<std::int64_t> GrainPartition::offsets() const {
  return {on_host_.data(), on_host_.data() + count_};
}

}  // namespace barchan
