#include "src/grains/ghost_grains.hpp"

#include <Kokkos_Sort.hpp>
#include <string>
#include <utility>
#include <vector>

#include "kernels/grains/pack.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

constexpr int kWhole = 13;  // kinematics and id
constexpr int kMotion = 9;  // position, velocity, spin
using Kinematics = Kokkos::View<GrainKinematics*>;

template <class View>
View room(const char* label, int n) {
  return View(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing),
              static_cast<std::size_t>(n));
}

}  // namespace

/// Fills sent_row_, in the order of the ranks that get the records, and counts_.
void GhostGrains::choose(const GrainState& grains, const Kinematics& kin,
                         const SearchColumns& columns, const GrainOwners& owners, MPI_Comm ranks) {
  const int n = grains.n, n_ranks = static_cast<int>(owners.start.extent(0));
  const auto first = room<Kokkos::View<int*>>("ghosts: first record", n);
  Kokkos::parallel_for(
      "ghosts: count records", items(n),
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
      "ghosts: first records", items(n_border),
      KOKKOS_LAMBDA(int b, int& sum, bool final) {
        const int count = first(border(b));
        if (final) first(border(b)) = sum;
        sum += count;
      },
      total);
  const auto rank = room<Kokkos::View<int*>>("ghosts: rank", total);
  const auto row = room<Kokkos::View<int*>>("ghosts: row", total);
  Kokkos::parallel_for(
      "ghosts: list records", items(n_border), KOKKOS_LAMBDA(int b) {
        const int g = border(b);
        const GhostDestinations destinations(columns, owners, kin(g).x);
        for (int q = 0; q < destinations.n; ++q) {
          rank(first(g) + q) = destinations.rank[q];
          row(first(g) + q) = g;
        }
      });
  // Few: their sorting by rank is left to the host.
  const auto rank_here = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, rank);
  const auto row_here = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, row);
  std::vector<std::vector<int>> rows_for(static_cast<std::size_t>(n_ranks));
  for (int p = 0; p < total; ++p)
    rows_for[static_cast<std::size_t>(rank_here(p))].push_back(row_here(p));
  sent_row_ = room<Kokkos::View<int*>>("ghosts: sent row", total);
  const auto sorted = Kokkos::create_mirror_view(sent_row_);
  std::vector<int> to;
  int p = 0;
  for (const auto& rows : rows_for) {
    to.push_back(static_cast<int>(rows.size()));
    for (const int g : rows) sorted(p++) = g;
  }
  Kokkos::deep_copy(sent_row_, sorted);
  counts_ = announce(ranks, std::move(to));
}

/// Takes what was received into the rows after the owned ones, in the order of the columns.
void GhostGrains::place(GrainState& grains, Kinematics& kin, const SearchColumns& columns) {
  const int n = grains.n, n_ghosts = count();
  grains.n_ghosts = n_ghosts;
  reserve_rows(kin, n + n_ghosts);
  reserve_rows(grains.id, n + n_ghosts);
  const auto key = room<Kokkos::View<std::uint64_t*>>("ghosts: key", n_ghosts);
  const auto order = room<Kokkos::View<int*>>("ghosts: order", n_ghosts);
  const Real* const received = receive_.data();
  Kokkos::parallel_for(
      "ghosts: keys", items(n_ghosts), KOKKOS_LAMBDA(int p) {
        Vec3 x;
        take_words(received + std::ptrdiff_t{kWhole} * p, x);
        key(p) = columns.key_of(x);
        order(p) = p;
      });
  Kokkos::Experimental::sort_by_key(Kokkos::DefaultExecutionSpace(), key, order);
  row_ = room<Kokkos::View<int*>>("ghosts: row", n_ghosts);
  const auto row = row_;
  const auto id = grains.id;
  const Kinematics to = kin;
  Kokkos::parallel_for(
      "ghosts: take", items(n_ghosts), KOKKOS_LAMBDA(int q) {
        const Real* from = received + std::ptrdiff_t{kWhole} * order(q);
        row(order(q)) = n + q;
        GrainKinematics& grain = to(n + q);
        take_words(from, grain.x), take_words(from + 3, grain.r);
        take_words(from + 4, grain.u), take_words(from + 7, grain.m);
        take_words(from + 8, grain.omega), take_words(from + 11, grain.padding);
        take_words(from + 12, id(n + q));
      });
}

void GhostGrains::find(GrainState& grains, Kinematics& kin, const SearchColumns& columns,
                       const GrainOwners& owners, MPI_Comm ranks) {
  choose(grains, kin, columns, owners, ranks);
  send_.reserve(static_cast<std::size_t>(counts_.n_to()) * kWhole);
  Real* const sent = send_.data();
  const auto row = sent_row_;
  const auto id = grains.id;
  const Kinematics from = kin;
  Kokkos::parallel_for(
      "ghosts: copy", items(counts_.n_to()), KOKKOS_LAMBDA(int p) {
        const GrainKinematics& grain = from(row(p));
        Real* to = sent + std::ptrdiff_t{kWhole} * p;
        put_words(to, grain.x_r()), put_words(to + 4, grain.u_m());
        put_words(to + 8, grain.spin()), put_words(to + 12, id(row(p)));
      });
  exchange(counts_, kWhole, send_, receive_);
  place(grains, kin, columns);
}

void GhostGrains::update(const Kinematics& kin) {
  Real* const sent = send_.data();
  const auto sent_row = sent_row_;
  Kokkos::parallel_for(
      "ghosts: send motion", items(counts_.n_to()), KOKKOS_LAMBDA(int p) {
        const GrainKinematics& grain = kin(sent_row(p));
        Real* to = sent + std::ptrdiff_t{kMotion} * p;
        put_words(to, grain.x), put_words(to + 3, grain.u), put_words(to + 6, grain.omega);
      });
  exchange(counts_, kMotion, send_, receive_);
  const Real* const received = receive_.data();
  const auto row = row_;
  Kokkos::parallel_for(
      "ghosts: take motion", items(counts_.n_from()), KOKKOS_LAMBDA(int p) {
        GrainKinematics& grain = kin(row(p));
        const Real* from = received + std::ptrdiff_t{kMotion} * p;
        take_words(from, grain.x), take_words(from + 3, grain.u);
        take_words(from + 6, grain.omega);
      });
}

}  // namespace barchan
