#include "src/grains/grain_feed.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "kernels/grains/body_contact.hpp"
#include "kernels/math/random.hpp"
#include "src/base/errors.hpp"
#include "src/grains/clumps.hpp"
#include "src/grains/kinds.hpp"
#include "src/grains/list_memory.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Number of places that are tried in a fluid step, one for each grain that waits.
constexpr int kPlaces = 64;
/// Purposes of random numbers.
enum Purpose : std::uint8_t { kBody, kAcross };

/// Gathers rows of Reals of all ranks on each of them, one rank after the other.
template <class Row>
std::vector<Row> of_all_ranks(MPI_Comm ranks, const std::vector<Row>& mine) {
  const auto me = static_cast<std::ptrdiff_t>(rank_of(ranks));
  std::vector<std::int64_t> counts(static_cast<std::size_t>(rank_count(ranks)));
  counts[static_cast<std::size_t>(me)] = static_cast<std::int64_t>(mine.size());
  sum_over(ranks, counts);
  const auto begin = std::accumulate(counts.begin(), counts.begin() + me, std::int64_t{0});
  const auto n = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  std::vector<Row> all(static_cast<std::size_t>(n));
  std::copy(mine.begin(), mine.end(), all.begin() + begin);
  constexpr std::size_t width = sizeof(Row) / sizeof(Real);
  all_reduce(ranks, std::span(reinterpret_cast<Real*>(all.data()), width * all.size()), MPI_SUM);
  return all;
}

/// Takes the bodies to choose from, and the first number that no grain has.
void look_at_start(GrainState& grains) {
  grains.feed.next_id = std::max(grains.last_id, grains.n_initial) + 1;
  grains.feed.bodies = bodies_of(grains);
}

/// Number of grains that are due and were not asked for. The sum of many parts of a grain may miss
/// a whole one by its last digits.
std::int64_t n_later(const FeedState& feed) {
  return static_cast<std::int64_t>(feed.due * (1 + 1e-12)) - feed.n_asked;
}

}  // namespace

GrainFeed::GrainFeed(const GrainsCase& config)
    : grains_(config.grains),
      config_(*config.grains.feed),
      bodies_(config.bodies),
      dt_(config.fluid_step),
      lz_(config.size[2]),
      walls_z_(config.grains.boundary_z == GrainBoundaryZ::wall),
      from_window_edge_(config.grains.boundary_x == GrainBoundaryX::follow),
      places_("feed: places", kPlaces),
      taken_("feed: taken places", kPlaces),
      n_leaving_("feed: grains that leave") {
  for (const KindConfig& kind : all_kinds(grains_)) width_.push_back(width_of(kind.shape));
}

void GrainFeed::advance(GrainState& grains, NeighborList& list) {
  FeedState& feed = grains.feed;
  if (feed.next_id == 0) look_at_start(grains);
  ++feed.n_steps;
  const bool has_begun = static_cast<Real>(feed.n_steps) * dt_ > config_.start;
  if (has_begun && config_.amount == FeedAmount::as_lost) note_leaving(grains, list);
  list.drop_left(grains);
  if (!has_begun) return;
  if (config_.amount == FeedAmount::given) ask_for_grains(feed);
  if (!feed.waiting.empty()) come_in(grains, list);
}

/// Adds the grains that are about to leave to those that wait, in the order of their numbers.
void GrainFeed::note_leaving(GrainState& grains, const NeighborList& list) {
  const CountLeaving who = list.leaving(grains);
  int n = 0;
  Kokkos::parallel_reduce("feed: count those that leave", items(grains.n), who, n);
  if (sum_over(grains.ranks, n) == 0) return;
  reserve(leaving_, "feed: bodies of those that leave", n);
  Kokkos::deep_copy(n_leaving_, 0);
  Kokkos::parallel_for(
      "feed: list those that leave", items(grains.n),
      ListLeavingGrains{
          .who = who, .id = grains.id, .kind = grains.kind, .leaving = leaving_, .n = n_leaving_});
  const auto mine = host_copy(leaving_);
  auto all =
      of_all_ranks(grains.ranks, std::vector(mine.data(), mine.data() + host_copy(n_leaving_)()));
  std::ranges::sort(all, {}, &LeavingGrain::id);
  for (const LeavingGrain& g : all) grains.feed.waiting.push_back({g.r, g.m, g.kind});
}

/// Asks for as many grains as are due at a given rate, with bodies of grains at the start. Of those
/// far back in the queue only the number is kept.
void GrainFeed::ask_for_grains(FeedState& feed) const {
  feed.due += config_.rate * dt_;
  if (feed.bodies.empty())
    throw InputError("grains.feed: no grains are left whose sizes it could take");
  while (feed.waiting.size() < kPlaces && n_later(feed) > 0) {
    const auto count = static_cast<std::uint64_t>(feed.n_asked++);
    const Real which = uniform_number(config_.seed, kBody, count);
    const auto body = static_cast<std::size_t>(which * static_cast<Real>(feed.bodies.size()));
    feed.waiting.push_back(feed.bodies[body]);
  }
}

/// Chooses a place for each of the first grains that wait.
std::vector<FeedPlace> GrainFeed::places_to_try(GrainState& grains, const PeriodicBox& box) const {
  FeedState& feed = grains.feed;
  std::vector<FeedPlace> places;
  for (const GrainBody& body : feed.waiting) {
    if (places.size() == kPlaces) break;
    auto [from, to] = config_.across;
    if (from == to) to = from + lz_;
    const Real r = radius_around(body);
    if (walls_z_) {
      const double last = std::max(r, lz_ - r);
      from = std::clamp(from, r, last);
      to = std::clamp(to, r, last);
    }
    const auto count = static_cast<std::uint64_t>(feed.n_tries++);
    const Real inlet =
        from_window_edge_ && std::isfinite(grains.window_edge) ? grains.window_edge : 0;
    const Real x = inlet + config_.x + r;
    const Real z = from + (to - from) * uniform_number(config_.seed, kAcross, count);
    places.push_back({.x = box.wrap({x, config_.height + r, z}), .r = r});
  }
  return places;
}

/// Number of ranks whose grains take each place.
std::vector<std::int64_t> GrainFeed::taken(const GrainState& grains,
                                           const std::vector<FeedPlace>& places,
                                           const PeriodicBox& box) const {
  const auto there = mirror(places_);
  std::ranges::copy(places, there.data());
  Kokkos::deep_copy(places_, there);
  Kokkos::deep_copy(taken_, 0);
  Kokkos::parallel_for("feed: taken places", items(grains.n),
                       MarkTakenPlaces{.box = box,
                                       .grains = grains.kin,
                                       .places = places_,
                                       .n_places = static_cast<int>(places.size()),
                                       .taken = taken_});
  const auto here = host_copy(taken_);
  std::vector<std::int64_t> all(here.data(), here.data() + places.size());
  sum_over(grains.ranks, all);
  return all;
}

/// Brings in the grains whose places are free.
void GrainFeed::come_in(GrainState& grains, NeighborList& list) const {
  FeedState& feed = grains.feed;
  const std::vector<FeedPlace> places = places_to_try(grains, list.box());
  const std::vector<std::int64_t> is_taken = taken(grains, places, list.box());
  std::vector<NewGrain> come;
  std::vector<GrainBody> waiting;
  for (std::size_t q = 0; q < feed.waiting.size(); ++q) {
    const bool free = q < places.size() && is_taken[q] == 0 &&
                      deepest_in(bodies_, places[q].x, places[q].r) == 0 &&
                      std::ranges::none_of(come, [&](const NewGrain& other) {
                        return places[q].overlaps(list.box(), other.x, radius_around(other.body));
                      });
    if (free) {
      come.push_back({.id = feed.next_id++, .body = feed.waiting[q], .x = places[q].x});
    } else {
      waiting.push_back(feed.waiting[q]);
    }
  }
  if (come.empty()) return;
  feed.waiting = waiting;
  feed.n_fed += static_cast<std::int64_t>(come.size());
  list.bring_in(grains, entries_of(come, list.box()));
}

/// Radius of the sphere around a grain, in which it may be turned as it likes.
Real GrainFeed::radius_around(const GrainBody& body) const {
  return width_[static_cast<std::size_t>(body.kind)] * body.r;
}

/// All spheres of new clumps, which get their orientations by their numbers; other grains stay as
/// they are.
std::vector<NewGrain> GrainFeed::entries_of(const std::vector<NewGrain>& come,
                                            const PeriodicBox& box) const {
  if (!has_clumps(grains_)) return come;
  InitialGrains whole;
  for (const NewGrain& one : come) {
    whole.add(one.id, 2 * one.body.r, one.x);
    whole.kind.push_back(static_cast<std::uint8_t>(one.body.kind));
  }
  const InitialGrains spheres = as_spheres(whole, grains_, config_.seed);
  std::vector<NewGrain> entries;
  auto of = come.begin();
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    while (of->id != clump_of_id(spheres.id[s])) ++of;
    ClumpMotion clump = spheres.clump[s];
    clump.m = of->body.m;  // at rest: nothing else depends on it
    entries.push_back({.id = spheres.id[s],
                       .body = {spheres.diameter[s] / 2, clump.m, of->body.kind},
                       .x = box.wrap(spheres.x[s]),
                       .clump = clump});
  }
  return entries;
}

std::vector<GrainBody> bodies_of(const GrainState& grains) {
  const GrainState whole = whole_grains(grains);
  const auto kin = host_copy(whole.kin);
  const auto kind = host_copy(whole.kind);
  std::vector<GrainBody> bodies;
  for (int g = 0; g < whole.n; ++g)
    bodies.push_back({.r = kin(g).r, .m = kin(g).m, .kind = kind.size() > 0 ? kind(g) : Real(0)});
  std::vector<GrainBody> all = of_all_ranks(grains.ranks, bodies);
  std::ranges::sort(all);
  return all;
}

std::int64_t n_waiting(const FeedState& feed) {
  return static_cast<std::int64_t>(feed.waiting.size()) + n_later(feed);
}

}  // namespace barchan
