#include "src/grains/ghost_grains.hpp"

#include <Kokkos_Sort.hpp>
#include <string>
#include <utility>
#include <vector>

#include "src/grains/grain_arrays.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

template <class View>
View room(const char* label, int n) {
  return View(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing),
              static_cast<std::size_t>(n));
}

}  // namespace

/// Fills sent_row_ and counts_.
void GhostGrains::choose(const GrainState& grains, const SearchColumns& columns,
                         const GrainOwners& owners, MPI_Comm ranks) {
  const auto kin = grains.kin;
  const int n = grains.n, n_ranks = static_cast<int>(owners.start.extent(0));
  const auto first = room<Kokkos::View<int*>>("ghosts: first copy", n);
  Kokkos::parallel_for(
      "ghosts: count copies", items(n),
      KOKKOS_LAMBDA(int g) { first(g) = GhostDestinations(columns, owners, kin(g).x).n; });
  const auto border = room<Kokkos::View<int*>>("ghosts: border", n);
  int n_border = 0;
  Kokkos::parallel_scan(
      "ghosts: grains at the border", items(n),
      KOKKOS_LAMBDA(int g, int& sum, bool final) {
        if (first(g) == 0) return;
        if (final) border(sum) = g;
        ++sum;
      },
      n_border);
  int total = 0;
  Kokkos::parallel_scan(
      "ghosts: first copies", items(n_border),
      KOKKOS_LAMBDA(int b, int& sum, bool final) {
        const int count = first(border(b));
        if (final) first(border(b)) = sum;
        sum += count;
      },
      total);
  const auto rank = room<Kokkos::View<int*>>("ghosts: rank", total);
  const auto row = room<Kokkos::View<int*>>("ghosts: row", total);
  Kokkos::parallel_for(
      "ghosts: list copies", items(n_border), KOKKOS_LAMBDA(int b) {
        const int g = border(b);
        const GhostDestinations destinations(columns, owners, kin(g).x);
        for (int q = 0; q < destinations.n; ++q) {
          rank(first(g) + q) = destinations.rank[q];
          row(first(g) + q) = g;
        }
      });
  auto sorted = sort_by_rank(rank, row, n_ranks);
  sent_row_ = sorted.row;
  counts_ = exchange_counts(ranks, std::move(sorted.to));
}

/// What was received, into the rows after the owned ones, in the order of the columns.
void GhostGrains::unpack(GrainState& grains, const SearchColumns& columns) {
  const int n = grains.n, n_ghosts = count();
  grains.n_ghosts = n_ghosts;
  reserve_rows(grains, n + n_ghosts, kGhosts);
  const auto key = room<Kokkos::View<std::uint64_t*>>("ghosts: key", n_ghosts);
  const auto order = room<Kokkos::View<int*>>("ghosts: order", n_ghosts);
  const PackLayout layout = layout_of(grains, kGhosts);
  const Real* const received = exchange_.received() + layout.offset_of(grains.kin.data());
  const int width = exchange_.width();
  Kokkos::parallel_for(
      "ghosts: keys", items(n_ghosts), KOKKOS_LAMBDA(int p) {
        const Real* x = received + std::ptrdiff_t{width} * p;
        key(p) = columns.key_of({x[0], x[1], x[2]});
        order(p) = p;
      });
  Kokkos::Experimental::sort_by_key(Kokkos::DefaultExecutionSpace(), key, order);
  row_ = room<Kokkos::View<int*>>("ghosts: row", n_ghosts);
  const auto row = row_;
  const UnpackRows unpack = exchange_.unpacking(layout, {}, n);
  Kokkos::parallel_for(
      "ghosts: unpack", items(n_ghosts), KOKKOS_LAMBDA(int q) {
        row(order(q)) = n + q;
        unpack.unpack(order(q), n + q);
      });
}

void GhostGrains::find(GrainState& grains, const SearchColumns& columns, const GrainOwners& owners,
                       MPI_Comm ranks) {
  choose(grains, columns, owners, ranks);
  exchange_.exchange(counts_, layout_of(grains, kGhosts), sent_row_);
  unpack(grains, columns);
}

void GhostGrains::update(const Kokkos::View<GrainKinematics*>& kin) {
  PackLayout motion;
  motion.add(kin, &GrainKinematics::x);
  motion.add(kin, &GrainKinematics::u);
  motion.add(kin, &GrainKinematics::omega);
  exchange_.exchange(counts_, motion, sent_row_);
  exchange_.unpack(motion, row_);
}

}  // namespace barchan
