#include "src/grains/grains_on_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "src/grains/list_memory.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

GrainsOnBodies::GrainsOnBodies(const GrainsCase& config, GrainState& grains, bool with_rolling,
                               Real law_reach)
    : bodies_(config.bodies),
      law_reach_(law_reach),
      farthest_(config.size[0] + config.size[1] + config.size[2]) {
  if (!any()) return;
  const auto n = static_cast<std::size_t>(std::max(grains.n, 1));
  const auto n_bodies = static_cast<std::size_t>(bodies_.n);
  using History = decltype(grains.body_xi_t);
  grains.body_xi_t = History("body xi_t", n, n_bodies);
  if (with_rolling) grains.body_torque = History("body torque", n, n_bodies);
  grains.body_touching = Kokkos::View<std::uint8_t*>("body touching", n);
  sums_ = Kokkos::View<ContactSum*>("contacts with bodies", n);
  totals_ = Kokkos::View<std::int64_t * [NearBodies::kParts]>("loads on bodies", n_bodies);
  contacts_ = Kokkos::View<std::int64_t*>("contacts of bodies", n_bodies);
}

void GrainsOnBodies::begin(const GrainState& grains, int n, Real strongest) {
  if (!any()) return;
  n_steps_ = n;
  // Unit of the sums: a power of two, so large that the sum of as many pairs as there are
  // spheres fits into 2^62.
  const Real spheres = std::max(grains.shapes.largest_count(), 1);
  const Real pairs = 4 * spheres * static_cast<Real>(grains.n_initial + grains.feed.n_fed + 1);
  const Real unit = std::exp2(std::ceil(std::log2(n * strongest * pairs)) - 62);
  per_force_ = 1 / unit;
  per_torque_ = per_force_ / std::exp2(std::ceil(std::log2(farthest_)));
  most_ = std::exp2(Real(62)) / pairs;
  Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), totals_, 0);
  if (near_.n > 0) Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), near_.load, 0);
}

void GrainsOnBodies::find(const GrainState& grains, std::int64_t rebuilds) {
  if (!any() || found_at_ == rebuilds) return;
  found_at_ = rebuilds;
  sum_pairs();
  reserve(marks_, "marks of bodies", grains.n);
  reserve(sums_, "contacts with bodies", grains.n);
  Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), sums_, ContactSum{});
  Kokkos::parallel_for("grains: mark near bodies", items(grains.n),
                       MarkNearBodies{.bodies = bodies_,
                                      .law_reach = law_reach_,
                                      .grains = grains.kin,
                                      .x_reference = grains.x_reference,
                                      .touching = grains.body_touching,
                                      .near = marks_});
  // The list mostly has room; if not, make it larger and search once more.
  for (int tries = 0; tries < 2; ++tries) {
    near_.n = scan("grains: list near bodies", items(grains.n),
                   ListNearBodies{.n_bodies = bodies_.n, .near = marks_, .list = near_});
    if (near_.n <= near_.grain.extent_int(0)) break;
    const int n = near_.n;
    reserve(near_.grain, "near bodies: grain", n);
    reserve(near_.body, "near bodies: body", n);
    reserve(near_.touches, "near bodies: touches", n);
    reserve(near_.load, "near bodies: load", n);
  }
}

void GrainsOnBodies::sum_pairs() const {
  if (near_.n == 0) return;
  Kokkos::deep_copy(Kokkos::DefaultExecutionSpace(), contacts_, 0);
  Kokkos::parallel_for("grains: sum loads on bodies", items(near_.n),
                       SumBodyLoads{.near = near_,
                                    .per_force = per_force_,
                                    .per_torque = per_torque_,
                                    .most = most_,
                                    .sums = totals_,
                                    .contacts = contacts_});
}

std::vector<GrainsOnBody> GrainsOnBodies::loads(MPI_Comm ranks) const {
  constexpr int parts = NearBodies::kParts;
  std::vector<GrainsOnBody> all(static_cast<std::size_t>(bodies_.n));
  if (!any()) return all;
  sum_pairs();
  const auto totals = host_copy(totals_);
  const auto contacts = host_copy(contacts_);
  std::vector<std::int64_t> sums;
  for (int b = 0; b < bodies_.n; ++b) {
    for (int part = 0; part < parts; ++part) sums.push_back(totals(b, part));
    sums.push_back(near_.n > 0 ? contacts(b) : 0);
  }
  sum_over(ranks, sums);
  const Real steps = std::max(n_steps_, 1);
  const auto* at = sums.data();
  for (GrainsOnBody& body : all) {
    const auto mean = [&](int first, Real per_unit) {
      const auto part = [&](int n) { return static_cast<Real>(at[first + n]) / per_unit / steps; };
      return Vec3{part(0), part(1), part(2)};
    };
    body.load = {.force = mean(0, per_force_), .torque = mean(3, per_torque_)};
    body.contacts = at[parts];
    at += parts + 1;
  }
  return all;
}

}  // namespace barchan
