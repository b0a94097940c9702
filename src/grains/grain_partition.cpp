#include "src/grains/grain_partition.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "src/base/report.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Place on the curve (upper half) and work (lower half) of each grain, sorted.
Kokkos::View<std::uint64_t*, Kokkos::HostSpace> work_by_place(
    const GrainState& grains, const SearchColumns& columns,
    const Kokkos::View<const int*>& contacts) {
  const int n = grains.n;
  const Kokkos::View<std::uint64_t*> of_grain("partition: work", static_cast<std::size_t>(n));
  const auto kin = grains.kin;
  const bool has_contacts = contacts.extent(0) > 0;
  Kokkos::parallel_for(
      "partition: work", items(n), KOKKOS_LAMBDA(int g) {
        const int sides = has_contacts ? contacts(g + 1) - contacts(g) : 0;
        of_grain(g) = (std::uint64_t{columns.place_of(kin(g).x)} << 32) |
                      static_cast<std::uint64_t>(2 + sides);
      });
  const Kokkos::View<std::uint64_t*, Kokkos::HostSpace> sorted("partition: sorted work",
                                                               of_grain.extent(0));
  Kokkos::deep_copy(sorted, of_grain);
  std::sort(sorted.data(), sorted.data() + n);
  return sorted;
}

/// Work by place on the curve, of the grains of one rank.
class WorkAlongCurve {
 public:
  WorkAlongCurve(const GrainState& grains, const SearchColumns& columns,
                 const Kokkos::View<const int*>& contacts) {
    const auto sorted = work_by_place(grains, columns, contacts);
    for (int g = 0; g < grains.n; ++g) {
      place_.push_back(static_cast<std::uint32_t>(sorted(g) >> 32));
      before_.push_back(total());
      sum_ += static_cast<std::int64_t>(sorted(g) & 0xffffffffu);
    }
  }
  std::int64_t total() const { return sum_; }
  /// Of the places before this one.
  std::int64_t before(std::uint64_t place) const {
    const auto at = std::lower_bound(place_.begin(), place_.end(), place);
    return at == place_.end() ? total() : before_[static_cast<std::size_t>(at - place_.begin())];
  }

 private:
  std::vector<std::uint32_t> place_;
  std::vector<std::int64_t> before_;
  std::int64_t sum_ = 0;
};

/// Where equal pieces of the work of all ranks begin, found together by bisection. Integers: the
/// same for any number of threads, and for any share of the grains among the ranks before.
std::vector<std::int64_t> equal_pieces(MPI_Comm ranks, const WorkAlongCurve& work,
                                       std::int64_t total, int count) {
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::int64_t> low(n, 0), high(n, std::int64_t{1} << 32), sum(n);
  for (int bit = 0; bit < 32; ++bit) {
    for (std::size_t r = 0; r < n; ++r)
      sum[r] = work.before(static_cast<std::uint64_t>(low[r] + high[r]) / 2);
    sum_over(ranks, sum);
    for (std::size_t r = 0; r < n; ++r) {
      const std::int64_t middle = (low[r] + high[r]) / 2;
      const bool enough = sum[r] * count >= total * static_cast<std::int64_t>(r);
      (enough ? high : low)[r] = middle;
    }
  }
  high[0] = 0;
  for (auto& start : high) start = std::min<std::int64_t>(start, 0xffffffff);
  return high;
}

Real largest_over_mean(MPI_Comm ranks, std::int64_t mine, std::int64_t total, int count) {
  const Real largest = max_over(ranks, static_cast<Real>(mine));
  return total > 0 ? largest * count / static_cast<Real>(total) : 1;
}

}  // namespace

GrainPartition::GrainPartition(MPI_Comm ranks)
    : ranks_(ranks),
      me_(rank_of(ranks)),
      count_(rank_count(ranks)),
      start_("partition: starts", static_cast<std::size_t>(count_)),
      on_host_(Kokkos::create_mirror_view(start_)) {}

bool GrainPartition::balance(const GrainState& grains, const SearchColumns& columns,
                             const Kokkos::View<const int*>& contacts) {
  int sides = 0;
  if (contacts.extent(0) > 0) Kokkos::deep_copy(sides, Kokkos::subview(contacts, grains.n));
  const std::int64_t mine = 2 * std::int64_t{grains.n} + sides;
  const std::int64_t total = sum_over(ranks_, mine);
  before_ = now_ = largest_over_mean(ranks_, mine, total, count_);
  const Real tolerable = std::max(kWorstImbalance, 1 + 2 * (at_cut_ - 1));
  if (has_cut_ && before_ <= tolerable) return false;
  const bool first = !has_cut_;
  const WorkAlongCurve work(grains, columns, contacts);
  set_starts(equal_pieces(ranks_, work, total, count_));
  std::vector<std::int64_t> piece;  // what each rank will have, from here
  for (int r = 0; r < count_; ++r) {
    const std::uint64_t end = r + 1 < count_ ? on_host_(r + 1) : std::uint64_t{1} << 32;
    piece.push_back(work.before(end) - work.before(on_host_(r)));
  }
  sum_over(ranks_, piece);
  const auto largest = static_cast<Real>(*std::max_element(piece.begin(), piece.end()));
  now_ = at_cut_ = total > 0 ? largest * count_ / static_cast<Real>(total) : 1;
  if (first) return true;
  report::info(
      "grains redistributed among {} ranks: the busiest had {:.3f} of the mean work and has "
      "{:.3f}",
      count_, before_, now_);
  return true;
}

void GrainPartition::set_starts(const std::vector<std::int64_t>& starts) {
  for (int r = 0; r < count_; ++r)
    on_host_(r) = static_cast<std::uint32_t>(starts[static_cast<std::size_t>(r)]);
  Kokkos::deep_copy(start_, on_host_);
  has_cut_ = true;
}

void GrainPartition::restore(const std::vector<std::int64_t>& starts, Real imbalance_at_cut) {
  set_starts(starts);
  at_cut_ = imbalance_at_cut;
}

std::vector<std::int64_t> GrainPartition::starts() const {
  return {on_host_.data(), on_host_.data() + count_};
}

}  // namespace barchan
